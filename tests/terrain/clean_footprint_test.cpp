#include "terrain/buildings/clean_footprint.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace fanbeam::terrain {
namespace {

double area_m2(const std::vector<Polygon_m>& polygons) {
  double sum_m2 = 0.0;
  for (const Polygon_m& rings : polygons)
    for (const Ring_m& ring : rings) sum_m2 += signed_area_m2(ring);
  return sum_m2;
}

// Does a ray to the east cross an odd number of edges?
bool inside(const std::vector<Polygon_m>& polygons, const glm::dvec2& point) {
  bool odd = false;
  for (const Polygon_m& rings : polygons)
    for (const Ring_m& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2& a = ring[i];
        const glm::dvec2& b = ring[(i + 1) % ring.size()];
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x) > point.x) odd = !odd;
      }
  return odd;
}

// Outlines turn left, courtyards right, no edge is a point, and just left of the middle of every
// edge is inside, just right of it outside.
void check_sides(const std::vector<Polygon_m>& polygons) {
  for (const Polygon_m& rings : polygons)
    for (std::size_t r = 0; r < rings.size(); ++r) {
      CHECK((signed_area_m2(rings[r]) > 0.0) == (r == 0));
      for (std::size_t i = 0; i < rings[r].size(); ++i) {
        const glm::dvec2& a = rings[r][i];
        const glm::dvec2& b = rings[r][(i + 1) % rings[r].size()];
        REQUIRE(a != b);
        const glm::dvec2 along = glm::normalize(b - a);
        const glm::dvec2 left(-along.y, along.x);
        CHECK(inside(polygons, 0.5 * (a + b) + 1e-3 * left));
        CHECK_FALSE(inside(polygons, 0.5 * (a + b) - 1e-3 * left));
      }
    }
}

std::vector<std::size_t> ring_counts(const std::vector<Polygon_m>& polygons) {
  std::vector<std::size_t> counts;
  for (const Polygon_m& rings : polygons) counts.push_back(rings.size());
  return counts;
}

using RingCounts = std::vector<std::size_t>;
const Ring_m kOutline{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
const Ring_m kYard{{3, 3}, {6, 3}, {6, 7}, {3, 7}};

}  // namespace

TEST_CASE("Outlines and courtyards have the building on their left, however they came",
          "[clean_footprint]") {
  for (const bool outline_turned : {false, true})
    for (const bool yard_turned : {false, true}) {
      Ring_m outline = kOutline;
      Ring_m yard = kYard;
      if (outline_turned) std::reverse(outline.begin(), outline.end());
      if (yard_turned) std::reverse(yard.begin(), yard.end());
      const auto polygons = clean_footprint(outline, {yard});
      CHECK(ring_counts(polygons) == RingCounts{2});
      CHECK(area_m2(polygons) == Approx(100.0 - 12.0).epsilon(1e-14));
      check_sides(polygons);
    }
}

TEST_CASE("A ring that crosses itself falls apart where it crosses", "[clean_footprint]") {
  const auto bow_tie = clean_footprint({{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {});
  CHECK(ring_counts(bow_tie) == RingCounts{1, 1});
  CHECK(area_m2(bow_tie) == Approx(8.0).epsilon(1e-12));
  check_sides(bow_tie);

  // Two squares of 4 m and 3 m that share the corner (4, 4), run through in one go.
  const auto eight =
      clean_footprint({{0, 0}, {4, 0}, {4, 4}, {7, 4}, {7, 7}, {4, 7}, {4, 4}, {0, 4}}, {});
  CHECK(ring_counts(eight) == RingCounts{1, 1});
  CHECK(area_m2(eight) == Approx(16.0 + 9.0).epsilon(1e-12));
  check_sides(eight);
}

TEST_CASE("A ring that comes back to a point of its own becomes outline and courtyard",
          "[clean_footprint]") {
  // Through (0, 0) twice, cutting a triangle of 4 m2 out of the square.
  const auto pinched =
      clean_footprint({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {2, 4}, {4, 4}}, {});
  CHECK(ring_counts(pinched) == RingCounts{2});
  CHECK(area_m2(pinched) == Approx(96.0).epsilon(1e-12));
  check_sides(pinched);
}

TEST_CASE("A courtyard may touch the outline, lie along it or reach out of it",
          "[clean_footprint]") {
  const auto touching_corner = clean_footprint(kOutline, {{{0, 0}, {4, 2}, {2, 4}}});
  CHECK(ring_counts(touching_corner) == RingCounts{2});
  CHECK(area_m2(touching_corner) == Approx(100.0 - 6.0).epsilon(1e-12));
  check_sides(touching_corner);

  const auto touching_side = clean_footprint(kOutline, {{{0, 4}, {3, 3}, {3, 5}}});
  CHECK(ring_counts(touching_side) == RingCounts{2});
  CHECK(area_m2(touching_side) == Approx(100.0 - 3.0).epsilon(1e-12));
  check_sides(touching_side);

  // It has no open side: what shares an edge with the outline is filled.
  const auto along = clean_footprint(kOutline, {{{0, 3}, {3, 3}, {3, 7}, {0, 7}}});
  CHECK(ring_counts(along) == RingCounts{1});
  CHECK(area_m2(along) == Approx(100.0).epsilon(1e-12));
  check_sides(along);

  // Half of it outside, where only one ring is around: 100 - 30 + 30.
  const auto out = clean_footprint(kOutline, {{{5, 2}, {15, 2}, {15, 8}, {5, 8}}});
  CHECK(area_m2(out) == Approx(100.0).epsilon(1e-12));
  check_sides(out);
}

TEST_CASE("Repeated points, spikes and slivers leave no ring and no edge", "[clean_footprint]") {
  const auto repeated =
      clean_footprint({{0, 0}, {0, 0}, {10, 0}, {10, 10}, {10, 10}, {0, 10}, {0, 0}},
                      {{{3, 3}, {3, 3}, {3, 3}}, {{4, 4}, {6, 6}, {5, 5}}});
  CHECK(ring_counts(repeated) == RingCounts{1});
  CHECK(repeated.at(0).at(0).size() == 4);
  check_sides(repeated);

  const auto spike =
      clean_footprint({{0, 0}, {10, 0}, {10, 5}, {17, 5}, {10, 5}, {10, 10}, {0, 10}}, {});
  CHECK(ring_counts(spike) == RingCounts{1});
  CHECK(area_m2(spike) == Approx(100.0).epsilon(1e-12));

  // 100 m long, 0.1 nm wide: less than the coordinates of a far building can say.
  const auto sliver = [](double x, double y) {
    return Ring_m{{x, y}, {x + 50.0, y}, {x + 100.0, y}, {x + 50.0, y + 1e-10}};
  };
  CHECK(clean_footprint(sliver(0, 0), {}).empty());
  CHECK(clean_footprint(sliver(9e5, 9e5), {}).empty());
  const auto yard_gone =
      clean_footprint({{-10, -10}, {110, -10}, {110, 10}, {-10, 10}}, {sliver(0, 0)});
  CHECK(ring_counts(yard_gone) == RingCounts{1});
  CHECK(clean_footprint({{0, 0}, {10, 0}}, {}).empty());
  CHECK(clean_footprint({}, {kYard}).empty());
}

}  // namespace fanbeam::terrain
