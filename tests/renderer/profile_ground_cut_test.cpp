// Where half-planes cut the ground: every piece lies in one triangle, and none is missing.
#include <catch2/catch.hpp>

#include "renderer/casting/profile/ground_cut.h"
#include "tests/renderer/profile_closed_form.h"

using namespace fanbeam;

namespace {

// Heights of 0 to 20 m at random, not square, its corner at no round number.
terrain::HeightField rough(int columns, int rows, double spacing_m) {
  terrain::HeightField field = terrain::make_height_field(
      -70.3, -41.9, -70.3 + spacing_m * (columns - 1), -41.9 + spacing_m * (rows - 1), spacing_m);
  for (std::size_t i = 0; i < field.height_m.size(); ++i)
    field.height_m[i] = 20.0 * tests::uniform(7, i);
  return field;
}

glm::dvec2 post(const terrain::HeightField& field, int column, int row) {
  return {field.west_m + field.spacing_m * column, field.south_m + field.spacing_m * row};
}

// What must hold for any cut; heights relative to 100 m.
void check_cut(const terrain::HeightField& field, const glm::dvec2& origin_m,
               const glm::dvec2& along, double far_m) {
  INFO("from " << origin_m.x << ", " << origin_m.y << " along " << along.x << ", " << along.y);
  renderer::GroundCut cut;
  renderer::cut_ground(field, origin_m, along, far_m, 100.0, cut);

  // Ends by brute force: the line's part inside the grid.
  double enter_m = 0.0, leave_m = far_m;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = axis == 0 ? field.west_m : field.south_m;
    const double high = axis == 0 ? field.east_m() : field.north_m();
    if (along[axis] == 0.0) {
      if (origin_m[axis] < low || origin_m[axis] > high) leave_m = -1.0;
      continue;
    }
    const double a = (low - origin_m[axis]) / along[axis];
    const double b = (high - origin_m[axis]) / along[axis];
    enter_m = std::max(enter_m, std::min(a, b));
    leave_m = std::min(leave_m, std::max(a, b));
  }
  constexpr double kTouch_m = 1e-9;
  if (leave_m - enter_m < kTouch_m) {
    // A corner touched within rounding may count or not.
    const double length_m = cut.pieces == 0 ? 0.0 : cut.distance_m[cut.pieces] - cut.distance_m[0];
    REQUIRE(length_m < kTouch_m);
    return;
  }
  REQUIRE(cut.pieces > 0);
  REQUIRE(cut.distance_m[0] == Approx(enter_m).epsilon(0.0).margin(1e-9));
  REQUIRE(cut.distance_m[cut.pieces] == Approx(leave_m).epsilon(0.0).margin(1e-9));

  for (std::size_t i = 0; i <= cut.pieces; ++i) {
    // Rounding may place a point of the rim outside, where there is no height.
    constexpr double kInwards_m = 1e-12;
    const glm::dvec2 at = glm::clamp(origin_m + along * cut.distance_m[i],
                                     glm::dvec2(field.west_m, field.south_m) + kInwards_m,
                                     glm::dvec2(field.east_m(), field.north_m()) - kInwards_m);
    REQUIRE(field.height_at(at.x, at.y).has_value());
    REQUIRE(cut.height_m[i] + 100.0 ==
            Approx(*field.height_at(at.x, at.y)).epsilon(0.0).margin(1e-9));
  }
  for (std::size_t i = 0; i < cut.pieces; ++i) {
    REQUIRE(cut.distance_m[i + 1] > cut.distance_m[i]);
    const auto [column, row, upper] = cut.cells[i];
    REQUIRE((column >= 0 && column < field.columns - 1 && row >= 0 && row < field.rows - 1));
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double d = cut.distance_m[i] + share * (cut.distance_m[i + 1] - cut.distance_m[i]);
      const double u = (origin_m.x + along.x * d - field.west_m) / field.spacing_m - column;
      const double v = (origin_m.y + along.y * d - field.south_m) / field.spacing_m - row;
      constexpr double kRounding = 1e-9;
      REQUIRE((u > -kRounding && u < 1.0 + kRounding && v > -kRounding && v < 1.0 + kRounding));
      REQUIRE((upper ? v - u : u - v) > -kRounding);
    }
  }
}

}  // namespace

TEST_CASE("A cut's pieces tile the line, each in its triangle, their ends on the surface",
          "[profile]") {
  const terrain::HeightField field = rough(23, 17, 10.0);
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    const double heading_rad = 2.0 * core::kPi * tests::uniform(1, trial, 0);
    // Inside the grid and around it: some cuts miss it.
    const glm::dvec2 origin(-150.0 + 400.0 * tests::uniform(1, trial, 1),
                            -120.0 + 300.0 * tests::uniform(1, trial, 2));
    check_cut(field, origin, {std::sin(heading_rad), std::cos(heading_rad)},
              trial % 3 == 0 ? 60.0 : 500.0);
  }
}

TEST_CASE("A cut exactly along grid lines and diagonals, from posts, rims and edges", "[profile]") {
  for (const double spacing_m : {10.0, 0.3, 250.0}) {
    const terrain::HeightField field = rough(9, 6, spacing_m);
    const double r = std::sqrt(0.5);
    for (const glm::dvec2 along : {glm::dvec2(1.0, 0.0),
                                   {-1.0, 0.0},
                                   {0.0, 1.0},
                                   {0.0, -1.0},
                                   {r, r},
                                   {-r, -r},
                                   {r, -r},
                                   {-r, r}})
      for (int row = 0; row < field.rows; ++row)
        for (int column = 0; column < field.columns; ++column) {
          const glm::dvec2 at = post(field, column, row);
          check_cut(field, at, along, 1e4);
          check_cut(field, at - 3.0 * spacing_m * along, along, 1e4);  // often from outside
          check_cut(field, at + glm::dvec2(0.5 * spacing_m, 0.0), along, 1e4);
          check_cut(field, at + glm::dvec2(0.25 * spacing_m), along, 1e4);
        }
  }
}

TEST_CASE("A cut almost along grid lines and diagonals", "[profile]") {
  const terrain::HeightField field = rough(9, 6, 10.0);
  for (const double turn_rad : {1e-17, 1e-15, 1e-12, 1e-9, 1e-6, -1e-17, -1e-15, -1e-12, -1e-9})
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double heading_rad = core::kPi / 4 * eighth + turn_rad;
      const glm::dvec2 along(std::sin(heading_rad), std::cos(heading_rad));
      check_cut(field, post(field, 4, 3), along, 1e3);
      check_cut(field, post(field, 4, 3) - 100.0 * along, along, 1e3);
    }
}

TEST_CASE("A cut through the smallest grid and one that ends on a post", "[profile]") {
  const terrain::HeightField one = rough(2, 2, 10.0);
  for (std::uint64_t trial = 0; trial < 500; ++trial) {
    const double heading_rad = 2.0 * core::kPi * tests::uniform(2, trial);
    check_cut(one, {-65.0, -37.0}, {std::sin(heading_rad), std::cos(heading_rad)}, 100.0);
  }
  const terrain::HeightField field = rough(9, 6, 10.0);
  check_cut(field, post(field, 1, 2), {1.0, 0.0}, 30.0);
  check_cut(field, post(field, 1, 2), {1.0, 0.0}, 1e-3);
  check_cut(field, post(field, 8, 2), {1.0, 0.0}, 30.0);  // from the rim outwards
}
