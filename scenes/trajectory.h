// A flight path that answers with a pose at any time.
#pragma once

#include <string>
#include <vector>

#include "core/pose.h"

namespace fanbeam::scenes {

// Poses at increasing times; heights above the scene's vertical datum are already ellipsoidal (or the scene's own).
//
// Position is interpolated along the chord in Earth-centred coordinates (correct over poles and the date line; the sag
// below the arc over a step d is d^2 / 8 Re, 0.2 m at 3 km, and is put back by interpolating the height), attitude on
// the short arc (slerp), velocity linearly. One pose is a fixed pose.
class Trajectory {
 public:
  // Throws InputError: E-TIME when times do not increase, E-RANGE or E-NONFINITE for an impossible pose.
  explicit Trajectory(std::vector<core::Pose> poses);

  double begin_s() const;
  double end_s() const;
  // `time_s` outside [begin, end] is E-TIME.
  core::Pose at(double time_s) const;

  // Frame k's time is the middle of its scan: begin + (k + 0.5) / rate, never accumulated. As many frames as end
  // before the trajectory does; one for a fixed pose.
  int frame_count(double frame_rate_Hz) const;
  double frame_time_s(int frame, double frame_rate_Hz) const;

  const std::vector<core::Pose>& poses() const { return poses_; }

  // True when roll, pitch or heading were not in the source and were derived from the path.
  bool attitude_derived = false;

 private:
  std::vector<core::Pose> poses_;
};

}  // namespace fanbeam::scenes
