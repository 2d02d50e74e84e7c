#include "scenes/waypoint_budget.h"

#include <string>

namespace fanbeam::scenes {

bool WaypointBudget::take(core::ConfigTable& target, std::string_view key, double count) {
  if (spent_) return false;
  taken_ += count;
  spent_ = taken_ > static_cast<double>(kMostTargetWaypoints);
  if (spent_)
    target.error(core::ErrorClass::limit, key,
                 core::number_text(taken_) + " waypoints of the targets so far",
                 "at most " + std::to_string(kMostTargetWaypoints) +
                     " of swings and road scenarios together: fewer targets, shorter ways");
  return !spent_;
}

}  // namespace fanbeam::scenes
