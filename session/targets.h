// A scene's point targets with some of them elsewhere.
#pragma once

#include <span>
#include <vector>

#include "core/errors.h"
#include "renderer/world.h"
#include "scenes/scene.h"
#include "session/conditions.h"

namespace fanbeam::session {

// E-REF for a name that the scene does not have and that comes without `rcs`, and for one that is
// there twice; E-RANGE for a name that is empty or has control characters or bytes that are no UTF-8;
// E-RANGE and E-NONFINITE for a position, attitude or rcs; E-LIMIT for too many.
std::vector<renderer::PointTarget> placed_targets(const scenes::Scene& scene,
                                                  std::span<const TargetState> states,
                                                  core::ProblemList& problems);

}  // namespace fanbeam::session
