// Numbers that several of these tests need.
#pragma once

#include <limits>

namespace fanbeam::tests {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double cubed(double x) { return x * x * x; }

}  // namespace fanbeam::tests
