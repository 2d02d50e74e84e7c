#include "renderer/casting/caster.h"

#include <algorithm>

#include "core/parallel.h"

namespace fanbeam::renderer {

void look_along_rays(const terrain::RayScene& surfaces, const glm::dvec3& sensor_m,
                     SightLines& sight) {
  constexpr std::size_t kAtOnce = 64;
  const std::size_t count = sight.to_m.size();
  core::parallel_for((count + kAtOnce - 1) / kAtOnce, [&](std::size_t block) {
    for (std::size_t i = block * kAtOnce; i < std::min((block + 1) * kAtOnce, count); ++i)
      if (sight.clear[i] == kAskRays)
        sight.clear[i] = surfaces.occluded(sensor_m, sight.to_m[i], kSightClearance_m) ? 0 : 1;
  });
}

}  // namespace fanbeam::renderer
