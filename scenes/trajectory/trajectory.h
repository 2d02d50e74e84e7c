// A flight path that answers with a pose at any time.
#pragma once

#include <vector>

#include "core/pose.h"
#include "scenes/trajectory/rejected_rows.h"

namespace fanbeam::scenes {

// Of one flight, 69 hours at 16 Hz: each is looked at before the first is rendered.
inline constexpr int kMostFrames = 4'000'000;

// Poses at increasing times; heights above the scene's vertical datum are already ellipsoidal (or
// the scene's own).
//
// Between two poses the position follows the chord of the two points on the ellipsoid, projected
// back onto it, so that poles and the date line are ordinary places; the height is interpolated by
// itself, so that the chord's sag (d^2 / 8 Re, 0.2 m at 3 km) is not in it. Along the track the
// chord is not walked at exactly constant speed; the error is below d^3 / (60 Re^2), 0.5 mm at
// 10 km. Attitude turns on the short arc (slerp) and velocity changes linearly, both in axes fixed
// to the Earth: north turns when the pole is passed. The path has corners in its poses: give them
// closely enough (0.1 s leaves 13 mm at 1 g).
class Trajectory {
 public:
  // Throws InputError with every problem: E-TIME when times do not increase; E-NONFINITE; E-RANGE
  // for a position outside terrain::check_geodetic, an attitude of a length not 1 within 1e-3, no
  // pose at all, or neighbours more than 1000 km apart.
  explicit Trajectory(std::vector<core::Pose> poses);

  double begin_s() const { return poses_.front().time_s; }
  double end_s() const { return poses_.back().time_s; }

  // Exactly the stored pose at a stored time. `time_s` outside [begin, end] is E-TIME and not
  // finite E-NONFINITE; a trajectory of one pose holds it at any time.
  core::Pose at(double time_s) const;

  // Frame k scans from begin + k / rate to begin + (k + 1) / rate; its time is the middle. Never
  // accumulated, so that a day at 16 Hz ends on the microsecond it should.
  // As many frames as end before the trajectory does; one for a fixed pose.
  // Throws InputError: E-RANGE for a rate outside 1e-3 to 1e6 Hz or a negative frame, E-NONFINITE,
  // E-LIMIT for more than kMostFrames.
  int frame_count(double frame_rate_Hz) const;
  double frame_time_s(int frame, double frame_rate_Hz) const;

  const std::vector<core::Pose>& poses() const { return poses_; }

  // True when roll, pitch or heading were not in the source and were derived from the path.
  bool attitude_derived = false;
  // Rows of the recording that were left out.
  std::vector<RejectedRows> rejected{};

 private:
  std::vector<core::Pose> poses_;
};

}  // namespace fanbeam::scenes
