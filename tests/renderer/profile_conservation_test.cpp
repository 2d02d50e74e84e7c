// What holds in any scene: a slice sees each elevation once, and the two pictures share one power.
#include <catch2/catch.hpp>

#include "renderer/casting/profile/ground_cut.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

constexpr double kFirst_m = 100.0;  // of the range gate
constexpr double kHalfExtent_m = 1000.0;

// The gate begins over level ground, where one elevation belongs to its first range, and ends
// behind the last post. Every elevation row down to that first range is in the C-scope.
sensors::Sensor all_seeing(double cell_m) {
  sensors::Sensor sensor = tests::even_hivision(4);
  sensor.range.minimum_m = kFirst_m;
  sensor.range.cell_m = cell_m;
  sensor.range.cells = static_cast<int>(1500.0 / cell_m);
  sensor.display.cscope_top_rad = core::radians(45.0);
  sensor.display.cscope_span_rad = core::radians(90.0);
  return sensor;
}

// Independent heights from post to post, level within 200 m.
terrain::HeightField rough(double relief_m) {
  std::uint64_t post = 0;
  return tests::ground(kHalfExtent_m, 10.0, [&](double x, double y) {
    ++post;
    return std::hypot(x, y) < 200.0 ? 0.0 : relief_m * (tests::uniform(11, post) - 0.5);
  });
}

// Overlapping, nested, rotated, partly below the ground, one higher than the sensor.
std::vector<terrain::Prism> town() {
  std::vector<terrain::Prism> prisms;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const glm::dvec2 centre(-60.0 + 120.0 * tests::uniform(12, i, 0),
                            300.0 + 550.0 * tests::uniform(12, i, 1));
    const double turn_rad = 2.0 * core::kPi * tests::uniform(12, i, 2);
    const double half_m = 3.0 + 20.0 * tests::uniform(12, i, 3);
    terrain::Ring_m ring;
    for (int corner = 0; corner < 5; ++corner)
      ring.push_back(centre + half_m * glm::dvec2(std::cos(turn_rad + 1.2566 * corner),
                                                  std::sin(turn_rad + 1.2566 * corner)));
    prisms.push_back({ring, {}, -40.0, -5.0 + 35.0 * tests::uniform(12, i, 4)});
  }
  prisms.back().top_m = 75.0;
  return prisms;
}

renderer::World scene(const sensors::Sensor& sensor, double relief_m, bool with_town) {
  std::vector<tests::Body> bodies;
  if (with_town)
    for (const terrain::Prism& prism : town()) bodies.push_back(tests::building(prism, 0, 0));
  return tests::world(sensor, rough(relief_m), {tests::kGamma}, std::move(bodies));
}

// Highest elevation of ground in one half-plane and of prisms in another, by brute force.
double horizon_rad(const renderer::World& world, double ground_heading_rad, double heading_rad) {
  const glm::dvec2 along_ground(std::sin(ground_heading_rad), std::cos(ground_heading_rad));
  const glm::dvec2 along(std::sin(heading_rad), std::cos(heading_rad));
  renderer::GroundCut cut;
  renderer::cut_ground(*world.surfaces().terrain(), {0.0, 0.0}, along_ground, 3000.0, kHeight_m,
                       cut);
  double tangent = -1e9;
  for (std::size_t i = 1; i <= cut.pieces; ++i)
    tangent = std::max(tangent, cut.height_m[i] / cut.distance_m[i]);
  for (const terrain::Solid& solid : world.solids().prisms)
    for (const auto& ring : solid.rings_m)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = ring[i], step = ring[(i + 1) % ring.size()] - a;
        const double across = along.x * step.y - along.y * step.x;
        const double distance_m = (a.x * step.y - a.y * step.x) / across;
        const double place = (a.x * along.y - a.y * along.x) / across;
        if (distance_m > 0.0 && place >= 0.0 && place < 1.0)
          tangent = std::max(tangent, (solid.top_m - kHeight_m) / distance_m);
      }
  return std::atan(tangent);
}

// Over the wedge that a sub-column's slice stands for: on the ground of the slice itself, and over
// the corners of buildings at headings of their own.
double mean_horizon_rad(const renderer::World& world, double heading_rad, double width_rad) {
  constexpr int kHeadings = 100;
  double sum_rad = 0.0;
  for (int k = 0; k < kHeadings; ++k)
    sum_rad +=
        horizon_rad(world, heading_rad, heading_rad + width_rad * ((k + 0.5) / kHeadings - 0.5));
  return sum_rad / kHeadings;
}

}  // namespace

TEST_CASE("A slice sees every elevation once, from the first range to the horizon", "[profile]") {
  // Ground and walls are one unbroken line in the half-plane. With sigma0 / sin(psi) = 0.02 the
  // power of a piece times R^2 is K 0.02 times the elevation it takes, so the sum over cells of
  // P R^2 lies between its values at their near and far borders; at their middles the error is that
  // of where in its cell the power lies.
  constexpr double kCell_m = 0.5;
  const sensors::Sensor sensor = all_seeing(kCell_m);
  for (const double relief_m : {0.0, 2.0, 20.0, 200.0})
    for (const bool with_town : {false, true}) {
      if (relief_m > 100.0 && with_town) continue;  // buried
      const renderer::World world = scene(sensor, relief_m, with_town);
      const renderer::FanSums sums =
          tests::cast_profile(world, 8, tests::level_antenna({0.0, 0.0, kHeight_m}));
      double worst = 0.0;
      for (int sub = 0; sub < sums.sub_columns; ++sub) {
        const double seen_rad =
            mean_horizon_rad(world, tests::slice_azimuth_rad(sums, sub), sums.step_rad) +
            std::asin(kHeight_m / kFirst_m);
        const double expected = sensor.radar_constant_W_m2() * 0.02 * seen_rad;
        double low = 0.0, middle = 0.0, high = 0.0;
        for (int k = 0; k < sums.cells; ++k) {
          const double power = sums.range_W_per_rad[static_cast<std::size_t>(sub * sums.cells + k)];
          const double near_m = kFirst_m + kCell_m * k;
          // A wall's wedge reaches one cell further at most: 0.25 m per slice at 900 m.
          low += power * std::pow(near_m - (with_town ? kCell_m : 0.0), 2);
          middle += power * std::pow(near_m + kCell_m / 2, 2);
          high += power * std::pow(near_m + kCell_m * (with_town ? 2.0 : 1.0), 2);
        }
        INFO("relief " << relief_m << " m, town " << with_town << ", sub-column " << sub);
        CHECK(low <= expected);
        CHECK(high >= expected);
        worst = std::max(worst, std::abs(middle / expected - 1.0));
      }
      CHECK(worst < 5e-4);
    }
}

TEST_CASE("Every range cell of rough ground holds the sum over what is seen of it", "[profile]") {
  // Against the plainest way to see a profile: point by point, what rises above all before it.
  // Where a slope faces the sensor the border of a cell is found as sqrt(R^2 - p^2) of two numbers
  // that are almost equal: wrong by 1e-16 R^2 / s, up to 1e-7 of a cell of 2 m here.
  for (const double cell_m : {2.0, 6.67, 100.0}) {
    const sensors::Sensor sensor = all_seeing(cell_m);
    const std::vector<double> level =
        tests::closed_form(sensor, {{{0.0, -kHeight_m}, {sensor.range.maximum_m(), -kHeight_m}}});
    for (const double relief_m : {0.5, 20.0, 60.0}) {
      const renderer::World world = scene(sensor, relief_m, false);
      const glm::dvec3 position_m(3.0, -2.0, kHeight_m);
      const renderer::FanSums sums =
          tests::cast_profile(world, 1, tests::level_antenna(position_m));
      for (int sub = 0; sub < sums.sub_columns; ++sub) {
        const double heading_rad = tests::slice_azimuth_rad(sums, sub);
        renderer::GroundCut cut;
        renderer::cut_ground(*world.surfaces().terrain(), {3.0, -2.0},
                             {std::sin(heading_rad), std::cos(heading_rad)}, 3000.0, kHeight_m,
                             cut);
        std::vector<tests::VisiblePiece> seen;
        double tangent = -1e9;
        for (std::size_t i = 0; i < cut.pieces; ++i) {
          glm::dvec2 near(cut.distance_m[i], cut.height_m[i]);
          const glm::dvec2 far(cut.distance_m[i + 1], cut.height_m[i + 1]);
          if (far.y <= tangent * far.x) continue;
          const double under = tangent * near.x - near.y, over = far.y - tangent * far.x;
          if (under > 0.0) near += under / (under + over) * (far - near);
          tangent = far.y / far.x;
          seen.push_back({near, far});
        }
        INFO("cells of " << cell_m << " m, relief " << relief_m << " m, sub-column " << sub);
        CHECK(tests::largest_error(sums, sub, tests::closed_form(sensor, seen), level, 0.01) <
              1e-7);
      }
    }
  }
}

TEST_CASE("C-scope rows hold the range cells' power times R^3", "[profile]") {
  // Exact but for where in its cell the power lies: 3 (cell / 2 R) at most, and far less on
  // average.
  constexpr double kCell_m = 1.0;
  const sensors::Sensor sensor = all_seeing(kCell_m);
  for (const double relief_m : {0.0, 2.0, 20.0, 60.0})
    for (const bool with_town : {false, true}) {
      const renderer::World world = scene(sensor, relief_m, with_town);
      const renderer::Frame frame = renderer::render_frame(
          world, renderer::profile_sampling_for(8.0), {}, {}, tests::level_pose(kHeight_m));
      for (std::size_t column = 0; column < 4; ++column) {
        double low = 0.0, middle = 0.0, high = 0.0, rows = 0.0;
        for (std::size_t k = 0; k < frame.bscope_W.size() / 4; ++k) {
          const double power_W = frame.bscope_W[4 * k + column];
          const double near_m = kFirst_m + kCell_m * static_cast<double>(k);
          low += power_W * std::pow(near_m - kCell_m, 3);
          middle += power_W * std::pow(near_m + kCell_m / 2, 3);
          high += power_W * std::pow(near_m + 2.0 * kCell_m, 3);
        }
        for (std::size_t i = column; i < frame.cscope_W_m3.size(); i += 4)
          rows += frame.cscope_W_m3[i];
        INFO("relief " << relief_m << " m, town " << with_town << ", column " << column);
        CHECK(low <= rows);
        CHECK(high >= rows);
        CHECK(rows / middle == Approx(1.0).epsilon(0.0).margin(1e-3));
      }
    }
}

TEST_CASE("A C-scope row of level ground holds the solid angle it covers", "[profile]") {
  // P R^3 per elevation is K 0.02 R, R = h / sin(e): K 0.02 h [ln tan(e / 2)] over a row. Pieces
  // spread evenly over their elevations, where the law changes by cell / R from end to end.
  sensors::Sensor sensor = all_seeing(1.0);
  sensor.display.cscope_top_rad = 0.0;
  sensor.display.cscope_span_rad = core::radians(30.0);
  sensor.display.cscope_rows = 300;
  for (const double spacing_m : {10.0, 250.0}) {
    const renderer::World world =
        tests::world(sensor, tests::ground(1750.0, spacing_m, [](double, double) { return 0.0; }),
                     {tests::kGamma});
    const renderer::FanSums sums =
        tests::cast_profile(world, 1, tests::level_antenna({3.0, 1.0, kHeight_m}), true);
    for (int row = 0; row < 300; ++row) {
      const double high_rad = core::radians(0.1 * row), low_rad = core::radians(0.1 * (row + 1));
      if (high_rad < std::asin(kHeight_m / sensor.range.maximum_m())) continue;
      const double expected = sensor.radar_constant_W_m2() * 0.02 * kHeight_m *
                              (std::log(std::tan(low_rad / 2)) - std::log(std::tan(high_rad / 2)));
      for (int sub = 0; sub < sums.sub_columns; ++sub)
        REQUIRE(sums.elevation_W_m3_per_rad[static_cast<std::size_t>(sub * 300 + row)] ==
                Approx(expected).epsilon(sensor.range.cell_m * std::sin(low_rad) / kHeight_m));
    }
  }
}
