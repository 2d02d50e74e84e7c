#include "session/products/obstacle_product.h"

#include <fmt/core.h>

#include "core/units.h"
#include "session/products/frame_table.h"

namespace fanbeam::session {

std::string obstacle_table(const std::vector<sensors::ShadowObstacle>& obstacles,
                           const core::Metadata& metadata) {
  std::string table = table_head("obstacles, heights estimated from radar shadows", metadata) +
                      "range_m,azimuth_deg,height_m,error_m,shadow_m,truncated,merged,uncertain\n";
  for (const sensors::ShadowObstacle& obstacle : obstacles) {
    const std::string height = obstacle.uncertain ? ","
                                                  : fmt::format("{:.2f},{:.2f}", obstacle.height_m,
                                                                obstacle.height_error_m);
    table += fmt::format("{:.2f},{:.3f},{},{:.1f},{:d},{:d},{:d}\n", obstacle.range_m,
                         core::degrees(obstacle.azimuth_rad), height, obstacle.shadow_length_m,
                         obstacle.truncated, obstacle.merged, obstacle.uncertain);
  }
  return table;
}

}  // namespace fanbeam::session
