#include "renderer/accuracy/sampling_ladder.h"

namespace fanbeam::renderer {

std::vector<double> sampling_ladder(CasterKind caster) {
  if (caster == CasterKind::profile)
    return {0.3, 0.5, 0.7, 1, 1.2, 1.4, 1.7, 2, 2.5, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
  return {0.5, 0.7, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 32, 64};
}

}  // namespace fanbeam::renderer
