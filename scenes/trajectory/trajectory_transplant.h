// Moves a flight from the runway it was flown to to another one.
//
// Every position is described by its geodesic from the runway's threshold: length, direction
// relative to the runway, height above the threshold. The same three are then laid off at the other
// threshold, so distance along and across the runway, glide path and, against the local direction
// to the threshold, heading are kept; pitch, roll and speed are untouched. Kept exactly: distance
// to the threshold and height above it. Neglected: the two places' Earth radii differ by up to 1 %,
// which stretches lengths across the line to the threshold by d^2 / 6 times the difference of the
// curvatures, below 1e-7 of themselves at 50 km; and that other terrain lies below.
#pragma once

#include "core/geodetic.h"
#include "scenes/trajectory/trajectory.h"

namespace fanbeam::scenes {

struct RunwayEnd {
  core::Geodetic threshold;
  double bearing_rad = 0.0;  // true, of landing
};

// Seen from the threshold in landing direction.
struct RunwayRelative {
  double before_threshold_m = 0.0;  // positive on the approach, negative over the runway
  double right_m = 0.0;             // positive right of the centre line for the landing pilot
  double height_m = 0.0;            // above the threshold, both above the ellipsoid
};

RunwayRelative relative_to(const RunwayEnd& runway, const core::Geodetic& position);
core::Geodetic position_from(const RunwayEnd& runway, const RunwayRelative& relative);

// Throws InputError: E-RANGE when a pose is more than 500 km from the runway it was flown to (which
// then is hardly the right one) or a threshold is outside terrain::check_geodetic; E-NONFINITE.
Trajectory transplant(const Trajectory& flight, const RunwayEnd& from, const RunwayEnd& to,
                      double time_shift_s = 0.0);

}  // namespace fanbeam::scenes
