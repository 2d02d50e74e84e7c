// A radar at 35 GHz, straight ahead of a target.
#pragma once

#include <glm/vec3.hpp>

#include "core/constants.h"

namespace fanbeam::tests {

inline constexpr double kLambda_m = core::kSpeedOfLight_mps / 35e9;
inline const glm::dvec3 kBoresight(1.0, 0.0, 0.0);

}  // namespace fanbeam::tests
