// Fronts of buildings: all slices that cut one stand for its width together.
#include <catch2/catch.hpp>

#include "tests/renderer/profile_closed_form.h"

namespace {

using namespace fanbeam;

constexpr double kHeight_m = 60.0, kTop_m = 23.0;

using Front = std::vector<glm::dvec2>;  // its corners from left to right

// A building, too thin for its sides to matter, on ground that sends nothing back.
renderer::World lone_building(const sensors::Sensor& sensor, const Front& front) {
  terrain::Ring_m ring(front.begin(), front.end());
  for (auto corner = front.rbegin(); corner != front.rend(); ++corner)
    ring.push_back({corner->x, corner->y + 0.1});
  return tests::world(sensor, tests::ground(1500.0, 10.0, [](double, double) { return 0.0; }),
                      {materials::PhongNrcs(), tests::kGamma},
                      {tests::building({ring, {}, -5.0, kTop_m}, 1, 0)});
}

sensors::Sensor near_sensor() {
  sensors::Sensor sensor = tests::even_hivision(164);
  sensor.range.cell_m = 10.0;
  sensor.range.cells = 120;
  return sensor;
}

// The walls' power in watts: the closed form of each azimuth over all that the front takes.
double expected_W(const sensors::Sensor& sensor, const Front& front, double sensor_x_m) {
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
      for (const double power : tests::closed_form(
               sensor, {{{distance_m, -kHeight_m}, {distance_m, kTop_m - kHeight_m}}}))
        sum_W += power * step_rad;
    }
  }
  return sum_W;
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

TEST_CASE("A front wider than a wedge sends back what its width does, wherever slices cut it",
          "[profile]") {
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

TEST_CASE(
    "A front narrower than a wedge is met as often as its width says, and then stands for one",
    "[profile]") {
  // 1 m wide, 0.38 of a wedge of 0.25 deg, under 200 shifts that go evenly through four wedges: met
  // 76 times, give or take one for each wedge.
  const sensors::Sensor sensor = near_sensor();
  const Front front{{-0.5, 603.0}, {0.5, 603.0}};
  const renderer::World world = lone_building(sensor, front);
  constexpr int kShifts = 200;
  const double wedge_m = 603.0 * core::radians(0.25);
  double found = 0.0, expected = 0.0;
  int met = 0;
  for (int shift = 0; shift < kShifts; ++shift) {
    const double x_m = 4.0 * wedge_m * (shift + 0.5) / kShifts;
    int lit = 0;
    const double one_W = found_W(world, x_m, &lit);
    const double whole_W = expected_W(sensor, front, x_m) * wedge_m;
    CHECK(lit <= 1);
    if (lit == 1) CHECK(one_W / whole_W == Approx(1.0).epsilon(0.0).margin(5e-3));
    met += lit;
    found += one_W;
    expected += expected_W(sensor, front, x_m);
  }
  CHECK(std::abs(met - kShifts / wedge_m) <= 4.0);
  CHECK(found / expected == Approx(1.0).epsilon(0.0).margin(4.0 / 76.0));
}
