// Buildings clipped to the wedges of slices: walls and shadows have their true widths.
#include <catch2/catch.hpp>

#include "renderer/casting/profile/wedge_strips.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

constexpr double kRoof_m = 23.0;

using Front = std::vector<glm::dvec2>;  // its corners from left to right

// A building, too thin for its sides to matter. Either its walls send something back or the ground.
renderer::World lone_building(const sensors::Sensor& sensor, const Front& front,
                              bool bright_ground = false) {
  terrain::Ring_m ring(front.begin(), front.end());
  for (auto corner = front.rbegin(); corner != front.rend(); ++corner)
    ring.push_back({corner->x, corner->y + 0.1});
  return tests::world(
      sensor, tests::ground(1500.0, 10.0, [](double, double) { return 0.0; }),
      {bright_ground ? tests::kGamma : materials::PhongNrcs(),
       bright_ground ? materials::PhongNrcs() : tests::kGamma, materials::PhongNrcs()},
      {tests::building({ring, {}, -5.0, kRoof_m}, 1, 2)});
}

sensors::Sensor near_sensor() {
  sensors::Sensor sensor = tests::even_hivision(164);
  sensor.range.cell_m = 10.0;
  sensor.range.cells = 120;
  return sensor;
}

// The power in watts of what a half-plane sees where it meets the front, over all that it takes.
template <class Pieces>
double power_W(const sensors::Sensor& sensor, const Front& front, double sensor_x_m,
               const Pieces& pieces_at) {
  constexpr int kSteps = 400;
  double sum_W = 0.0;
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    const glm::dvec2 a = front[i] - glm::dvec2(sensor_x_m, 0.0);
    const glm::dvec2 b = front[i + 1] - glm::dvec2(sensor_x_m, 0.0);
    const double from_rad = std::atan2(a.x, a.y), to_rad = std::atan2(b.x, b.y);
    const double step_rad = (to_rad - from_rad) / kSteps;
    const glm::dvec2 wall = b - a;
    for (int k = 0; k < kSteps; ++k) {
      const double at_rad = from_rad + (k + 0.5) * step_rad;
      const glm::dvec2 along(std::sin(at_rad), std::cos(at_rad));
      const double distance_m =
          (a.x * wall.y - a.y * wall.x) / (along.x * wall.y - along.y * wall.x);
      for (const double power : tests::closed_form(sensor, {pieces_at(distance_m)}))
        sum_W += power * step_rad;
    }
  }
  return sum_W;
}

tests::VisiblePiece wall_at(double distance_m) {
  return {{distance_m, -kHeight_m}, {distance_m, kRoof_m - kHeight_m}};
}
// From the wall's foot to where the ray over its top comes down.
tests::VisiblePiece shadow_at(double distance_m) {
  return {{distance_m, -kHeight_m}, {distance_m * kHeight_m / (kHeight_m - kRoof_m), -kHeight_m}};
}

double expected_W(const sensors::Sensor& sensor, const Front& front, double sensor_x_m) {
  return power_W(sensor, front, sensor_x_m, wall_at);
}

double found_W(const renderer::World& world, double sensor_x_m, int* lit = nullptr) {
  const renderer::FanSums sums =
      tests::cast_profile(world, 1, tests::level_antenna({sensor_x_m, 0.0, kHeight_m}));
  double sum_W = 0.0;
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    double power = 0.0;
    for (int k = 0; k < sums.cells; ++k)
      power += sums.range_W_per_rad[static_cast<std::size_t>(sub * sums.cells + k)];
    if (lit != nullptr && power > 0.0) ++*lit;
    sum_W += power * sums.step_rad;
  }
  return sum_W;
}

}  // namespace

TEST_CASE("A front sends back what its width does, wherever slices cut it", "[profile]") {
  // Wedges of 0.25 deg, 2.6 m at 600 m, against fronts of 3 to 5 of them: by whole wedges each
  // would be wrong by up to 17 to 10 %. What is left is that a part of a wall has its middle's
  // distance: 0.5 % where ranges differ by 6 % within one.
  const sensors::Sensor sensor = near_sensor();
  const Front flat{{-4.0, 603.0}, {4.0, 603.0}};
  const Front oblique{{-6.0, 640.0}, {6.0, 603.0}};
  const Front bent{{-6.0, 640.0}, {-2.0, 601.0}, {-1.2, 600.0}, {5.0, 605.0}};
  for (const Front& front : {flat, oblique, bent}) {
    const renderer::World world = lone_building(sensor, front);
    for (int shift = 0; shift < 20; ++shift) {
      const double x_m = 0.137 * shift;
      INFO("shift " << x_m << " m of " << front.size() << " corners");
      CHECK(found_W(world, x_m) / expected_W(sensor, front, x_m) ==
            Approx(1.0).epsilon(0.0).margin(8e-3));
    }
  }
}

// Whole groups of sub-columns reach past straight behind there, where headings jump.
TEST_CASE("A front is not lost in columns of tens of degrees", "[profile]") {
  struct Case {
    double field_of_view_deg;
    int columns;
  };
  const Front front{{-4.0, 603.0}, {4.0, 603.0}};
  for (const Case& of : {Case{115.0, 3}, {118.0, 3}, {118.0, 1}}) {
    sensors::Sensor sensor = near_sensor();
    sensor.scan.field_of_view_rad = core::radians(of.field_of_view_deg);
    sensor.scan.columns = of.columns;
    sensor.antenna.azimuth.half_power_width_rad = core::radians(10.0);
    sensor.antenna.azimuth.cut_rad = core::radians(15.0);
    INFO(of.columns << " columns");
    CHECK(found_W(lone_building(sensor, front), 0.0) / expected_W(sensor, front, 0.0) ==
          Approx(1.0).epsilon(0.0).margin(8e-3));
  }
}

TEST_CASE("An oblique wall falls into range cells as its heights and headings do", "[profile]") {
  // In each wedge ranges differ by the wall's height and across it: a cell that holds no more than
  // the wall's highest corner gets the thin end of a trapezoid. An even spread puts up to 1.7 times
  // as much there.
  sensors::Sensor sensor = near_sensor();
  sensor.range.cell_m = 1.0;
  sensor.range.cells = 700;
  const Front front{{-12.0, 640.0}, {12.0, 603.0}};
  const renderer::World world = lone_building(sensor, front);
  const renderer::FanSums sums =
      tests::cast_profile(world, 1, tests::level_antenna({0.0, 0.0, kHeight_m}));
  const glm::dvec2 wall = front[1] - front[0];
  constexpr int kHeadings = 1000;
  int slivers = 0;
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double left_rad = sums.first_azimuth_rad + sub * sums.step_rad;
    if (left_rad < std::atan2(front[0].x, front[0].y) ||
        left_rad + sums.step_rad > std::atan2(front[1].x, front[1].y))
      continue;
    std::vector<double> expected(static_cast<std::size_t>(sums.cells), 0.0);
    for (int k = 0; k < kHeadings; ++k) {
      const double at_rad = left_rad + sums.step_rad * (k + 0.5) / kHeadings;
      const glm::dvec2 along(std::sin(at_rad), std::cos(at_rad));
      const double distance_m =
          (front[0].x * wall.y - front[0].y * wall.x) / (along.x * wall.y - along.y * wall.x);
      const auto power = tests::closed_form(sensor, {wall_at(distance_m)});
      for (std::size_t c = 0; c < expected.size(); ++c) expected[c] += power[c] / kHeadings;
    }
    double whole = 0.0;
    for (const double power : expected) whole += power;
    for (std::size_t c = 0; c < expected.size(); ++c) {
      INFO("sub-column " << sub << ", cell " << c);
      const double found =
          sums.range_W_per_rad[static_cast<std::size_t>(sub) * expected.size() + c];
      CHECK(found / whole == Approx(expected[c] / whole).epsilon(0.0).margin(0.01));
      if (expected[c] < 1e-4 * whole || expected[c] > 0.01 * whole) continue;
      ++slivers;
      CHECK(found / expected[c] == Approx(1.0).epsilon(0.0).margin(0.2));
    }
  }
  CHECK(slivers >= 5);
}

TEST_CASE("A front narrower than a wedge is never missed, and counts with its width", "[profile]") {
  // 1 m wide, 0.38 of a wedge of 0.25 deg: between most slices it stands unseen by both.
  const sensors::Sensor sensor = near_sensor();
  const Front front{{-0.5, 603.0}, {0.5, 603.0}};
  const renderer::World world = lone_building(sensor, front);
  constexpr int kShifts = 40;
  const double wedge_m = 603.0 * core::radians(0.25);
  for (int shift = 0; shift < kShifts; ++shift) {
    const double x_m = 2.0 * wedge_m * (shift + 0.5) / kShifts;
    INFO("shift " << x_m << " m");
    int lit = 0;
    CHECK(found_W(world, x_m, &lit) / expected_W(sensor, front, x_m) ==
          Approx(1.0).epsilon(0.0).margin(1e-3));
    CHECK(lit >= 1);
    CHECK(lit <= 2);
  }
}

TEST_CASE("A shadow takes what its width does, wherever slices cut it", "[profile]") {
  // The same fronts and a narrow one on bright ground. What is missing against the ground alone lies
  // in their shadows; by whole wedges it would be 17 to 160 % off. A part of a wall that is 6 %
  // nearer at one end than at the other casts its middle's shadow: 0.5 %.
  const sensors::Sensor sensor = near_sensor();
  const renderer::World open = tests::world(
      sensor, tests::ground(1500.0, 10.0, [](double, double) { return 0.0; }), {tests::kGamma});
  const Front narrow{{-0.5, 603.0}, {0.5, 603.0}};
  const Front flat{{-4.0, 603.0}, {4.0, 603.0}};
  const Front oblique{{-6.0, 640.0}, {6.0, 603.0}};
  for (const Front& front : {narrow, flat, oblique}) {
    const renderer::World world = lone_building(sensor, front, true);
    for (int shift = 0; shift < 10; ++shift) {
      const double x_m = 0.274 * shift;
      INFO("shift " << x_m << " m of the front from " << front.front().x << " m");
      const double missing_W = found_W(open, x_m) - found_W(world, x_m);
      CHECK(missing_W / power_W(sensor, front, x_m, shadow_at) ==
            Approx(1.0).epsilon(0.0).margin(8e-3));
    }
  }
}

TEST_CASE("Strips of a wedge part at corners and are one again where they see alike", "[profile]") {
  renderer::WedgeStrips strips;
  strips.reset({-1.0, 1.0}, {});
  REQUIRE(strips.one());
  const auto count = [](const renderer::WedgeStrips::Span& span) { return span.last - span.first; };
  // Borders of the wedge and of strips split nothing.
  CHECK(count(strips.within({-1.0, 1.0})) == 1);
  CHECK(count(strips.within({-0.25, 0.5})) == 1);
  CHECK(count(strips.all()) == 3);
  CHECK(count(strips.within({-1.0, 0.5})) == 2);
  CHECK(count(strips.within({0.5, 1.0})) == 1);
  CHECK(strips.at(0.0).range.left_rad == -0.25);
  CHECK(strips.at(1.0).range.left_rad == 0.5);

  for (renderer::WedgeStrip& strip : strips.within({-0.25, 0.5})) {
    CHECK(strips.enter(strip, 7, -0.1));
    strip.roofed = true;
  }
  strips.join();
  CHECK(count(strips.all()) == 3);
  // Indoors a hidden building is not passed by.
  CHECK_FALSE(strips.hide(-2e300, {-1.0, 1.0}));
  CHECK(strips.hide(-2e300, {0.5, 1.0}));
  for (renderer::WedgeStrip& strip : strips.within({-0.25, 0.5})) {
    CHECK(strips.leave(strip, 7, -0.1));
    strip.roofed = false;
    strip.horizon_tangent = -0.1;
  }
  strips.join();
  CHECK(count(strips.all()) == 3);  // what is behind the building is in its shadow
  for (renderer::WedgeStrip& strip : strips.all()) strip.horizon_tangent = -0.05;
  strips.join();
  CHECK(strips.one());
  CHECK(strips.all().first->range.left_rad == -1.0);
  CHECK(strips.all().first->range.right_rad == 1.0);
}

TEST_CASE("A strip that is told the way out of a building first is not left inside", "[profile]") {
  renderer::WedgeStrips strips;
  strips.reset({-1.0, 1.0}, {});
  renderer::WedgeStrip& strip = *strips.all().first;
  strip.horizon_tangent = -0.2;
  CHECK_FALSE(strips.leave(strip, 3, -0.1));
  CHECK_FALSE(strips.enter(strip, 3, -0.1));
  CHECK(strips.enter(strip, 3, -0.1));
  CHECK(strips.leave(strip, 3, -0.1));
  // One that is hidden whole is passed by, in and out.
  CHECK_FALSE(strips.enter(strip, 4, -0.3));
  CHECK_FALSE(strips.leave(strip, 4, -0.3));
  CHECK(strips.enter(strip, 4, -0.1));
}
