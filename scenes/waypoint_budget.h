// How many waypoints the targets of one scene may have together, where the scene's file does not hold
// them but a few numbers make them: legs of swings, paths of road scenarios.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/config_table.h"

namespace fanbeam::scenes {

// Some 250 bytes for each of a road scenario, 50 for each of a swing.
inline constexpr std::size_t kMostTargetWaypoints = 2'000'000;

class WaypointBudget {
 public:
  // False where `count` more are too many, and from then on: that is E-LIMIT at `key` of the target
  // that asks for them first.
  bool take(core::ConfigTable& target, std::string_view key, double count);
  bool is_spent() const { return spent_; }

 private:
  double taken_ = 0.0;
  bool spent_ = false;
};

}  // namespace fanbeam::scenes
