// Shadows and walls of the profile caster: their borders split range cells exactly.
#include <catch2/catch.hpp>

#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

sensors::Sensor near_sensor(double cell_m, int cells) {
  sensors::Sensor sensor = tests::even_hivision(4);
  sensor.range.cell_m = cell_m;
  sensor.range.cells = cells;
  return sensor;
}

terrain::HeightField level(double spacing_m = 10.0) {
  return tests::ground(1500.0, spacing_m, [](double, double) { return 0.0; });
}

// Everything that stands across the view at constant north is d / cos(azimuth) away.
using Profile = std::function<std::vector<tests::VisiblePiece>(double cosine)>;

double largest_error(const renderer::World& world, const renderer::FanSums& sums,
                     const Profile& profile) {
  double largest = 0.0;
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double cosine = std::cos(tests::slice_azimuth_rad(sums, sub));
    largest = std::max(largest, tests::largest_error(
                                    sums, sub, tests::closed_form(world.sensor, profile(cosine))));
  }
  return largest;
}

// Where the line of sight over the point (distance, height above the ground) meets the ground.
double shadow_end_m(double distance_m, double top_m) {
  return distance_m * kHeight_m / (kHeight_m - top_m);
}

}  // namespace

TEST_CASE("A ridge hides exactly the ground behind its crest, and the border splits its cell",
          "[profile]") {
  const sensors::Sensor sensor = near_sensor(6.67, 180);
  constexpr double kCrest_m = 620.0, kTop_m = 20.0, kPosts_m = 10.0;
  const renderer::World world =
      tests::world(sensor,
                   tests::ground(1500.0, kPosts_m,
                                 [](double, double y) { return y == kCrest_m ? kTop_m : 0.0; }),
                   {tests::kGamma});
  const renderer::FanSums sums =
      tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}));
  const Profile profile = [&](double cosine) -> std::vector<tests::VisiblePiece> {
    const double foot_m = (kCrest_m - kPosts_m) / cosine, crest_m = kCrest_m / cosine;
    const double far_m = sensor.range.maximum_m();
    return {{{0.0, -kHeight_m}, {foot_m, -kHeight_m}},
            {{foot_m, -kHeight_m}, {crest_m, kTop_m - kHeight_m}},
            {{shadow_end_m(crest_m, kTop_m), -kHeight_m}, {far_m, -kHeight_m}}};
  };
  CHECK(largest_error(world, sums, profile) < 1e-9);
}

TEST_CASE("A hollow hides its near slope and the ground below the line over its edge",
          "[profile]") {
  // Ground at 0, a trench of 40 m depth over posts 600 to 700 m north, ground at 0 again: the line
  // over the near edge meets the trench's floor or far slope.
  const sensors::Sensor sensor = near_sensor(6.67, 180);
  constexpr double kNear_m = 600.0, kFar_m = 700.0, kDepth_m = 40.0, kPosts_m = 10.0;
  const renderer::World world = tests::world(
      sensor,
      tests::ground(1500.0, kPosts_m,
                    [](double, double y) { return y > kNear_m && y < kFar_m ? -kDepth_m : 0.0; }),
      {tests::kGamma});
  const renderer::FanSums sums =
      tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}));
  const Profile profile = [&](double cosine) -> std::vector<tests::VisiblePiece> {
    const double near_m = kNear_m / cosine, far_m = kFar_m / cosine;
    const double slope_m = kPosts_m / cosine;  // horizontal extent of the far slope
    // -h d / near = -h - depth (far - d) / slope
    const double out_m =
        (kHeight_m + kDepth_m * far_m / slope_m) / (kHeight_m / near_m + kDepth_m / slope_m);
    return {{{0.0, -kHeight_m}, {near_m, -kHeight_m}},
            {{out_m, -kHeight_m * out_m / near_m}, {far_m, -kHeight_m}},
            {{far_m, -kHeight_m}, {sensor.range.maximum_m(), -kHeight_m}}};
  };
  CHECK(largest_error(world, sums, profile) < 1e-9);
}

TEST_CASE("A building's wall, roof and shadow hold their exact integrals", "[profile]") {
  // Cells of 20 m hold the whole face: 602.7 to 605.9 m of range, and its spread over the wedge.
  // Roof, ground in front and the end of the shadow are cut exactly.
  const sensors::Sensor sensor = near_sensor(20.0, 60);
  constexpr double kFront_m = 603.0, kBack_m = 631.0, kTop_m = 23.0;
  for (const double spacing_m : {10.0, 250.0}) {
    const renderer::World world =
        tests::world(sensor, level(spacing_m), {tests::kGamma},
                     {tests::box({-300.0, kFront_m, -5.0}, {300.0, kBack_m, kTop_m}, 0)});
    const renderer::FanSums sums =
        tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}));
    const Profile profile = [&](double cosine) -> std::vector<tests::VisiblePiece> {
      const double front_m = kFront_m / cosine, back_m = kBack_m / cosine;
      const double roof_m = kTop_m - kHeight_m;
      return {{{0.0, -kHeight_m}, {front_m, -kHeight_m}},
              {{front_m, -kHeight_m}, {front_m, roof_m}},
              {{front_m, roof_m}, {back_m, roof_m}},
              {{shadow_end_m(back_m, kTop_m), -kHeight_m}, {sensor.range.maximum_m(), -kHeight_m}}};
    };
    CHECK(largest_error(world, sums, profile) < 1e-9);
  }
}

TEST_CASE("A lower building behind a higher one shows what rises above the line of sight",
          "[profile]") {
  const sensors::Sensor sensor = near_sensor(20.0, 60);
  constexpr double kFirst_m = 603.0, kFirstBack_m = 611.0, kFirstTop_m = 23.0;
  constexpr double kSecond_m = 645.0, kSecondBack_m = 652.0, kSecondTop_m = 29.0;
  const renderer::World world =
      tests::world(sensor, level(), {tests::kGamma},
                   {tests::box({-300.0, kSecond_m, -5.0}, {300.0, kSecondBack_m, kSecondTop_m}, 0),
                    tests::box({-300.0, kFirst_m, -5.0}, {300.0, kFirstBack_m, kFirstTop_m}, 0)});
  const renderer::FanSums sums =
      tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}));
  const Profile profile = [&](double cosine) -> std::vector<tests::VisiblePiece> {
    const double front_m = kFirst_m / cosine, edge_m = kFirstBack_m / cosine;
    const double second_m = kSecond_m / cosine, back_m = kSecondBack_m / cosine;
    const double first_m = kFirstTop_m - kHeight_m, roof_m = kSecondTop_m - kHeight_m;
    return {
        {{0.0, -kHeight_m}, {front_m, -kHeight_m}},
        {{front_m, -kHeight_m}, {front_m, first_m}},
        {{front_m, first_m}, {edge_m, first_m}},
        {{second_m, first_m * second_m / edge_m}, {second_m, roof_m}},
        {{second_m, roof_m}, {back_m, roof_m}},
        {{shadow_end_m(back_m, kSecondTop_m), -kHeight_m}, {sensor.range.maximum_m(), -kHeight_m}}};
  };
  CHECK(largest_error(world, sums, profile) < 1e-9);
}

TEST_CASE("A tower higher than the sensor hides all behind it", "[profile]") {
  const sensors::Sensor sensor = near_sensor(20.0, 60);
  constexpr double kFront_m = 603.0;
  const renderer::World world =
      tests::world(sensor, level(), {tests::kGamma},
                   {tests::box({-300.0, kFront_m, -5.0}, {300.0, 640.0, 95.0}, 0)});
  const renderer::FanSums sums =
      tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}));
  const Profile profile = [&](double cosine) -> std::vector<tests::VisiblePiece> {
    const double front_m = kFront_m / cosine;
    return {{{0.0, -kHeight_m}, {front_m, -kHeight_m}}, {{front_m, -kHeight_m}, {front_m, 35.0}}};
  };
  CHECK(largest_error(world, sums, profile) < 1e-9);
}

TEST_CASE("A wall's grazing angle counts from the wall, seen obliquely", "[profile]") {
  // sigma0 = 0.1 sin^2(psi), sin(psi) = q / R with q the distance of the wall's plane. Its value at
  // the wall's middle stands for all of it: the range changes by 0.4 % over the wall, its square by
  // less than 1e-4 more than its mean. Ground of nothing leaves the wall alone.
  const materials::PhongNrcs dark, square(0.0, 0.1, 2.0);
  const sensors::Sensor sensor = near_sensor(400.0, 4);
  const renderer::World world = tests::world(
      sensor, level(), {dark, square},
      {tests::building(
          {{{-300.0, 603.0}, {300.0, 603.0}, {300.0, 640.0}, {-300.0, 640.0}}, {}, -5.0, 23.0}, 1,
          0)});
  for (const double heading_rad : {0.0, -0.4}) {
    const renderer::FanSums sums =
        tests::cast_profile(world, 8, tests::level_antenna({3.3, 0.0, kHeight_m}, heading_rad));
    for (int sub = 0; sub < sums.sub_columns; ++sub) {
      const double cosine = std::cos(heading_rad + tests::slice_azimuth_rad(sums, sub));
      const double front_m = 603.0 / cosine;
      const std::vector<double> expected = tests::closed_form(
          sensor, {{{front_m, -kHeight_m}, {front_m, 23.0 - kHeight_m}, square, 603.0}});
      REQUIRE(tests::largest_error(sums, sub, expected) < 1e-4);
    }
  }
}

TEST_CASE("An oblique wall spreads over the ranges it takes within a slice's wedge", "[profile]") {
  // What remains of sampling: a wedge of width w sees a wall at angle b from its normal spread over
  // d tan(b) w of range. One slice per column must light those cells and no others, and lose
  // nothing of the wall.
  const materials::PhongNrcs dark;
  sensors::Sensor sensor = near_sensor(0.5, 2000);
  const renderer::World world = tests::world(
      sensor, level(), {dark, tests::kGamma},
      {tests::building(
          {{{-600.0, 603.0}, {300.0, 603.0}, {300.0, 640.0}, {-600.0, 640.0}}, {}, -5.0, 23.0}, 1,
          0)});
  constexpr double kHeading_rad = -0.6;
  const renderer::FanSums sums =
      tests::cast_profile(world, 1, tests::level_antenna({3.3, 0.0, kHeight_m}, kHeading_rad));
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double azimuth_rad = -kHeading_rad - tests::slice_azimuth_rad(sums, sub);
    const double near_m = 603.0 / std::cos(azimuth_rad - sums.step_rad / 2);
    const double far_m = 603.0 / std::cos(azimuth_rad + sums.step_rad / 2);
    const double nearest_m = std::hypot(near_m, kHeight_m - 23.0);
    const double farthest_m = std::hypot(far_m, kHeight_m);
    double total = 0.0;
    for (int k = 0; k < sums.cells; ++k) {
      const double power = sums.range_W_per_rad[static_cast<std::size_t>(sub * sums.cells + k)];
      const double cell_m = sensor.range.minimum_m + sensor.range.cell_m * k;
      total += power;
      if (cell_m > farthest_m + 0.5 || cell_m < nearest_m - 1.0) REQUIRE(power == 0.0);
      if (cell_m < farthest_m - 0.5 && cell_m > nearest_m) REQUIRE(power > 0.0);
    }
    const double front_m = 603.0 / std::cos(azimuth_rad);
    const std::vector<double> expected =
        tests::closed_form(sensor, {{{front_m, -kHeight_m}, {front_m, 23.0 - kHeight_m}}});
    double expected_total = 0.0;
    for (const double power : expected) expected_total += power;
    REQUIRE(total == Approx(expected_total).epsilon(1e-9));
  }
}
