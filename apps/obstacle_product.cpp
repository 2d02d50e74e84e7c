#include "apps/obstacle_product.h"

#include <fmt/core.h>

#include <fstream>

#include "core/units.h"

namespace fanbeam::apps {
namespace {

std::string comment(const std::string& fingerprint) {
  return "# obstacles, heights estimated from radar shadows, of the input " + fingerprint;
}

}  // namespace

std::string obstacle_table(const std::vector<sensors::ShadowObstacle>& obstacles,
                           const std::string& fingerprint) {
  std::string table =
      comment(fingerprint) +
      "\nrange_m,azimuth_deg,height_m,error_m,shadow_m,truncated,merged,uncertain\n";
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

std::filesystem::path obstacle_table_path(const std::filesystem::path& folder, int frame) {
  return folder / "obstacles" / fmt::format("{:05}.csv", frame);
}

bool has_obstacle_table(const std::filesystem::path& folder, int frame,
                        const std::string& fingerprint) {
  std::ifstream stream(obstacle_table_path(folder, frame));
  std::string line;
  return std::getline(stream, line) && line == comment(fingerprint);
}

}  // namespace fanbeam::apps
