// How far two renderings of a scene lie apart.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "renderer/frame.h"

namespace fanbeam::tests {

// Of any pixel of both pictures, in unrounded grey levels.
inline double largest_difference_grey(const renderer::Frame& a, const renderer::Frame& b) {
  REQUIRE(a.bscope_grey.size() == b.bscope_grey.size());
  REQUIRE(a.cscope_grey.size() == b.cscope_grey.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.bscope_grey.size(); ++i)
    worst = std::max(worst, std::abs(a.bscope_grey[i] - b.bscope_grey[i]));
  for (std::size_t i = 0; i < a.cscope_grey.size(); ++i)
    worst = std::max(worst, std::abs(a.cscope_grey[i] - b.cscope_grey[i]));
  return worst;
}

}  // namespace fanbeam::tests
