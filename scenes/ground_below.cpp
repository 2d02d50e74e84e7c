#include "scenes/ground_below.h"

#include <cmath>

namespace fanbeam::scenes {

std::optional<core::Geodetic> ground_below(const Scene& scene, core::Geodetic at) {
  constexpr int kMostSteps = 8;
  constexpr double kNear_m = 1e-5;
  const terrain::HeightField* ground = scene.world.surfaces().terrain();
  if (ground == nullptr) return std::nullopt;
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dvec3 local = scene.frame.to_local_m(at);
    const auto ground_m = ground->height_at(local.x, local.y);
    if (!ground_m) return std::nullopt;
    const double above_m = local.z - *ground_m;
    at.height_m -= above_m;
    if (std::abs(above_m) < kNear_m) break;
  }
  return at;
}

}  // namespace fanbeam::scenes
