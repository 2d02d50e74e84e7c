// What is known of one target.
#pragma once

#include <array>
#include <optional>

#include "tracking/filters/imm.h"
#include "tracking/tracker/existence.h"

namespace fanbeam::tracking {

struct Track {
  int id = 0;
  bool confirmed = false;
  ImmState state;
  int hits = 0, frames = 0, coasted = 0;
  double unseen_s = 0.0;  // since it was measured last
  // Logarithm of the likelihood of a target over that of false measurements, until it is confirmed.
  double log_ratio = 0.0;
  std::optional<int> unresolved_with;  // id of the other one
  double unresolved_s = 0.0;           // so far
  int unresolved_unseen = 0;           // frames since anything was measured of either
  std::optional<int> given_up_with;    // unresolved for too long, and not seen apart since
  // One of a pair, for as long as that is set aside: this may have begun on its only echo.
  std::optional<int> began_on;
  Existence existence;  // since it was confirmed
  // That the target is still the one the track started with.
  double identity_probability = 1.0;
};

// Two tracks that could not be told apart and then were, or were given up: with this probability they
// have exchanged their targets.
struct Crossing {
  double time_s = 0.0;  // when they parted, or were given up
  int first = 0, second = 0;
  double swap_probability = 0.0;
  bool given_up = false;
};

// Speed over ground is above `least_mps` by two standard deviations of its own uncertainty:
// a target that beams has no range rate, but its angle moves. On one axis: the speed along it.
bool is_moving(const Track& track, const std::array<double, 2>& radar_velocity_mps,
               double least_mps = 1.0);

}  // namespace fanbeam::tracking
