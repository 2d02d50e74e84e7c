// Flies an instrument approach that nobody recorded.
//
// Path. The aircraft's reference point follows the localiser course to where it meets the extended
// centre line, turns onto that within `largest_bank_rad`, follows it over the threshold, flares,
// lands and rolls out. Distances are along the ground (the ellipsoid) from the threshold. The glide
// path is a straight line in space, as a beam without refraction is: `glide_path_rad` steep at the
// threshold, `threshold_crossing_height_m` above it, so that over a distance s the Earth falls away
// by s^2 / 2R (R: radius of curvature of the ellipsoid in that direction; error below 1 mm at
// 30 km). On a plane Earth it is straight in the scene's frame.
//
// Flare. From `flare_height_m` the path's slope shrinks linearly with distance down to the sink
// rate of touchdown: height and sink rate are continuous, the added load is constant (0.04 g at 70
// m/s).
//
// Speed is constant until touchdown, then falls by a constant deceleration. The wind is constant
// everywhere; the aircraft holds its track by crab, which it takes off during the flare. Pitch is
// the path angle through the air plus an angle of attack, growing to the touchdown pitch in the
// flare and falling to the slope of the runway in the 4 s after touchdown; roll is that of a
// coordinated turn. Gusts are Dryden's (scenes/trajectory/dryden.h) with height above the runway as
// height above ground, and displace the aircraft as scenes/trajectory/trajectory_turbulence.h says;
// they fade out over the last 30 m of height.
//
// Neglected: wind shear, loss of speed in the flare, beam bends, localiser and glide path captures.
#pragma once

#include <cstdint>
#include <optional>

#include "core/geodetic.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

enum class ApproachEnd { decision_height, touchdown, full_stop };
enum class SpeedKind { true_air, ground };  // ground: over the ground on the centre line

struct IlsApproach {
  core::Geodetic threshold;         // height: the runway's surface above the ellipsoid
  double runway_bearing_rad = 0.0;  // true, of landing
  double runway_slope = 0.0;        // rise per metre in landing direction, -0.2 to 0.2

  std::optional<double> localiser_course_rad;  // true; absent: the bearing. At most 30 deg off it
  // Where an offset course meets the centre line; absent: where the glide path is at the decision
  // height. 0 to 20 km, and the turn must end before the flare.
  std::optional<double> crossing_distance_m;

  double glide_path_rad = core::radians(3.0);  // 1 to 10 deg
  double threshold_crossing_height_m = 15.0;   // of the reference point, 5 to 50
  double start_distance_m = 10e3;              // up to 100 km, before the turn and the flare

  double speed_mps = 70.0;  // horizontal, 15 to 150
  SpeedKind speed_kind = SpeedKind::true_air;
  double wind_speed_mps = 0.0;  // 0 to 40, and at least 5 m/s below the airspeed
  double wind_from_rad = 0.0;   // true

  double turbulence_wind_20ft_mps = 0.0;  // W20 of MIL-F-8785C, 0 (none) to 60
  std::uint64_t seed = 1;

  double angle_of_attack_rad = core::radians(4.0);  // assumed; -10 to 20 deg
  double largest_bank_rad = core::radians(15.0);    // 1 to 45 deg

  ApproachEnd end = ApproachEnd::touchdown;
  double decision_height_m = 200.0 * core::kFoot_m;  // above the threshold, 20 to 300
  double flare_height_m = 12.0;                      // wheels above the runway, 1 to 50
  double touchdown_sink_mps = 0.6;                   // 0.1 to 3, less than the approach's
  double touchdown_pitch_rad = core::radians(5.0);   // above the runway, assumed; -5 to 15 deg
  double height_on_ground_m = 3.0;  // of the reference point with the wheels on the runway, 0 to 15
  double rollout_deceleration_mps2 = 1.8;  // 0.5 to 5

  double begin_s = 0.0;
};

// Poses 0.02 s apart, whatever the frame rate. The trajectory ends with the last whole step before
// the end asked for. `frame` is the scene's: it says which Earth.
// Throws InputError with every problem found: E-RANGE, E-NONFINITE.
Trajectory fly_ils_approach(const IlsApproach& approach, const terrain::LocalFrame& frame);

}  // namespace fanbeam::scenes
