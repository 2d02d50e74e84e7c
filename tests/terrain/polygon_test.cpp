// Inside or outside of outlines.
#include "terrain/polygon.h"

#include <catch2/catch.hpp>

namespace fanbeam::terrain {
namespace {

using Ring = std::vector<glm::dvec2>;

TEST_CASE("Inside and outside of an outline that is not convex, either way round", "[polygon]") {
  Ring ell = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  for (int turn = 0; turn < 2; ++turn) {
    CHECK(crosses_odd(ell, 3.0, 0.5));
    CHECK(crosses_odd(ell, 0.5, 3.0));
    CHECK_FALSE(crosses_odd(ell, 2.0, 2.0));
    CHECK_FALSE(crosses_odd(ell, -1.0, 1.0));  // level with a corner
    CHECK_FALSE(crosses_odd(ell, -1.0, 0.0));
    CHECK_FALSE(crosses_odd(ell, 5.0, 0.5));
    ell = Ring(ell.rbegin(), ell.rend());
  }
}

TEST_CASE("Outlines side by side share no point and leave none out", "[polygon]") {
  // Four squares around the origin, in eighths: every edge and corner is exact.
  const auto square = [](double west, double south) {
    return Ring{{west, south}, {west + 1, south}, {west + 1, south + 1}, {west, south + 1}};
  };
  for (int j = -8; j < 8; ++j)
    for (int i = -8; i < 8; ++i) {
      int holders = 0;
      for (const double west : {-1.0, 0.0})
        for (const double south : {-1.0, 0.0})
          if (crosses_odd(square(west, south), i / 8.0, j / 8.0)) ++holders;
      INFO(i << ' ' << j);
      CHECK(holders == 1);
    }
}

TEST_CASE("No outline holds nothing", "[polygon]") {
  CHECK_FALSE(crosses_odd({}, 0.0, 0.0));
  CHECK_FALSE(crosses_odd({{0, 0}}, 0.0, 0.0));
  CHECK_FALSE(crosses_odd({{0, 0}, {1, 1}}, 0.5, 0.5));
}

}  // namespace
}  // namespace fanbeam::terrain
