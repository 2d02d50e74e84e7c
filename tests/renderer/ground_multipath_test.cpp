// Point targets over reflecting ground against the textbook's two-ray pattern.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "renderer/plan/plan.h"
#include "renderer/stages/point_targets.h"
#include "renderer/surfaces/bistatic_nrcs.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using renderer::Multipath;
using tests::antenna_at;

namespace {

// Grass, but 40 dB down: what it scattered it would not mirror.
const materials::PhongNrcs kFaintGrass(0.0325e-4, 0.136e-4, 1.99);
// Gamma = -1 in horizontal polarisation to 1e-4.
const materials::SpecularSurface kMetal{{1.0, 1e9}, 0.0};

// A target of 1 m2 over flat ground, and an elevation beam so wide that both paths have its gain.
renderer::World flat_world(double distance_m, double height_m,
                           const std::optional<materials::SpecularSurface>& ground,
                           std::vector<tests::Body> bodies = {}) {
  sensors::Sensor sensor = tests::hivision(8);
  sensor.antenna.elevation.half_power_width_rad = 100.0;
  sensor.antenna.elevation.cut_rad = 1.5;
  const double half_extent_m = std::max(4000.0, distance_m + 1000.0);
  renderer::World world =
      tests::world(sensor, tests::ground(half_extent_m, 250.0, [](double, double) { return 0.0; }),
                   {kFaintGrass, kFaintGrass}, std::move(bodies));
  world.specular = {ground};
  world.targets = {
      {"sphere", materials::ConstantRcs{1.0}, {{0.0, {0.0, distance_m, height_m}}}, glm::dmat3(1)}};
  return world;
}

std::vector<core::Echo> echoes(const renderer::World& world, double sensor_height_m,
                               Multipath multipath) {
  return renderer::point_echoes(world, antenna_at(sensor_height_m), 0.0, multipath);
}

double total_W(const std::vector<core::Echo>& echoes) {
  double sum = 0.0;
  for (const core::Echo& echo : echoes) sum += echo.power_W;
  return sum;
}

double gain(const renderer::World& world, double sensor_height_m, Multipath multipath) {
  return total_W(echoes(world, sensor_height_m, multipath)) /
         total_W(echoes(world, sensor_height_m, Multipath::none));
}

// The height of a target whose paths differ by `longer_m`, by their definition and halving.
double height_for_m(double distance_m, double sensor_m, double longer_m) {
  double low_m = 0.0, high_m = 5.0;
  for (int i = 0; i < 60; ++i) {
    const double h_m = (low_m + high_m) / 2;
    const double d_m =
        4.0 * sensor_m * h_m /
        (std::hypot(distance_m, sensor_m + h_m) + std::hypot(distance_m, sensor_m - h_m));
    (d_m < longer_m ? low_m : high_m) = h_m;
  }
  return low_m;
}

// Received power of one frame over the whole picture.
double frame_W(const renderer::World& world, const renderer::Effects& effects) {
  const renderer::Frame frame =
      renderer::render_frame(world, {}, {}, effects, tests::level_pose(60.0));
  double sum = 0.0;
  for (const double value : frame.bscope_W) sum += value;
  return sum;
}

}  // namespace

TEST_CASE("G02 the ground path is longer by 0.0799839870383 m", "[multipath]") {
  const renderer::World world = flat_world(3000.0, 2.0, kMetal);
  const auto path = renderer::ground_path(world, antenna_at(60.0), {0.0, 3000.0, 2.0});
  REQUIRE(path);
  CHECK(path->longer_m == Approx(0.0799839870383).epsilon(0.0).margin(1e-12));
  CHECK(path->amplitude.real() == Approx(-1.0).epsilon(0.0).margin(1e-3));
  CHECK(path->elevation_rad == Approx(-std::atan(62.0 / 3000.0)).epsilon(0.0).margin(1e-9));
}

// Of lengths near 37 km, whose double steps are 7e-12 m, the difference of two square roots is off by
// 3.1e-12 m: 4.7e-8 of what is asked for (by 50 digits).
TEST_CASE("G02 at 37 km the ground path to a stone of 2 cm is longer by 64.86 um", "[multipath]") {
  const renderer::World world = flat_world(37000.0, 0.02, kMetal);
  const auto path = renderer::ground_path(world, antenna_at(60.0), {0.0, 37000.0, 0.02});
  REQUIRE(path);
  CHECK(path->longer_m == Approx(6.4864779578860878e-5).epsilon(1e-12).margin(0.0));
  const double by_roots_m = std::hypot(37000.0, 60.02) - std::hypot(37000.0, 59.98);
  CHECK(std::abs(by_roots_m / 6.4864779578860878e-5 - 1.0) > 1e-8);
}

TEST_CASE("Over a perfect mirror the echo follows 16 sin^4(2 pi h1 h2 / (lambda R))",
          "[multipath]") {
  constexpr double kDistance_m = 3000.0, kSensor_m = 60.0;
  const double wavelength_m = tests::hivision().wavelength_m();
  for (int i = 0; i <= 40; ++i) {
    const double height_m = 0.5 + 0.01 * i;  // over two lobes
    const renderer::World world = flat_world(kDistance_m, height_m, kMetal);
    const double range_m = std::hypot(kDistance_m, kSensor_m - height_m);
    const double textbook =
        16.0 *
        std::pow(std::sin(2.0 * core::kPi * kSensor_m * height_m / (wavelength_m * range_m)), 4);
    INFO("height " << height_m);
    CHECK(gain(world, kSensor_m, Multipath::coherent) ==
          Approx(textbook).epsilon(0.0).margin(0.05));
  }
}

TEST_CASE("A lobe is 12 dB up and a null is dark", "[multipath]") {
  constexpr double kDistance_m = 2000.0, kSensor_m = 80.0;
  const double half_m = tests::hivision().wavelength_m() / 2;
  const auto height_m = [&](double longer_m) {
    return height_for_m(kDistance_m, kSensor_m, longer_m);
  };
  const double lobe =
      gain(flat_world(kDistance_m, height_m(21 * half_m), kMetal), kSensor_m, Multipath::coherent);
  CHECK(10.0 * std::log10(lobe) == Approx(12.0412).epsilon(0.0).margin(0.01));
  const double null =
      gain(flat_world(kDistance_m, height_m(20 * half_m), kMetal), kSensor_m, Multipath::coherent);
  CHECK(10.0 * std::log10(null) < -80.0);
}

TEST_CASE("The mean is 1 + 4 r^2 + r^4, and the mean of the coherent pattern over heights",
          "[multipath]") {
  constexpr double kDistance_m = 1500.0, kSensor_m = 90.0;
  const materials::SpecularSurface soil{{4.0, 0.5}, 0.004};
  const renderer::World world = flat_world(kDistance_m, 3.0, soil);
  const auto path = renderer::ground_path(world, antenna_at(kSensor_m), {0.0, kDistance_m, 3.0});
  REQUIRE(path);
  const double square = std::norm(path->amplitude);
  CHECK(square > 0.05);
  CHECK(square < 0.95);
  CHECK(gain(world, kSensor_m, Multipath::mean) ==
        Approx(1.0 + 4.0 * square + square * square).epsilon(1e-12));
  double sum = 0.0;
  constexpr int kSteps = 4000;
  // Ten whole periods of the pattern: lambda R / (2 h1) each.
  const double span_m = 10.0 * tests::hivision().wavelength_m() *
                        std::hypot(kDistance_m, kSensor_m) / (2.0 * kSensor_m);
  for (int i = 0; i < kSteps; ++i)
    sum += gain(flat_world(kDistance_m, 3.0 + span_m * (i + 0.5) / kSteps, soil), kSensor_m,
                Multipath::coherent);
  CHECK(sum / kSteps == Approx(gain(world, kSensor_m, Multipath::mean)).epsilon(0.01));
}

TEST_CASE("Paths that end in different range cells are echoes of their own", "[multipath]") {
  // d = 4 h1 h2 / (R + R') = 39 m: six cells.
  const renderer::World world = flat_world(1000.0, 100.0, kMetal);
  const double direct_m = std::hypot(1000.0, 100.0), image_m = std::hypot(1000.0, 300.0);
  const double direct_W = total_W(echoes(world, 200.0, Multipath::none));
  for (const Multipath multipath : {Multipath::mean, Multipath::coherent}) {
    const std::vector<core::Echo> found = echoes(world, 200.0, multipath);
    REQUIRE(found.size() == 3);
    const double loss = direct_m / image_m;  // of one way by the ground, as amplitude
    CHECK(found[0].power_W == Approx(direct_W));
    CHECK(found[1].power_W == Approx(4.0 * loss * loss * direct_W).epsilon(1e-3));
    CHECK(found[2].power_W == Approx(std::pow(loss, 4) * direct_W).epsilon(1e-3));
    CHECK(found[1].range_m == Approx((direct_m + image_m) / 2).epsilon(0.0).margin(1e-9));
    CHECK(found[2].range_m == Approx(image_m).epsilon(0.0).margin(1e-9));
    CHECK(found[2].elevation_rad == Approx(-std::atan(0.3)).epsilon(0.0).margin(1e-9));
  }
}

TEST_CASE("A tilted plane reflects as the level one does, seen from its own normal",
          "[multipath]") {
  const double slope = 0.02;
  renderer::World world = flat_world(3000.0, 2.0, kMetal);
  world.geometry = tests::geometry(
      tests::ground(4000.0, 250.0, [&](double, double y_m) { return slope * y_m; }));
  const glm::dvec3 target_m(0.0, 3000.0, slope * 3000.0 + 2.0);
  const auto path = renderer::ground_path(world, antenna_at(200.0), target_m);
  REQUIRE(path);
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
  const double direct_m = glm::distance(target_m, glm::dvec3(0.0, 0.0, 200.0));
  const double heights_m2 = 4.0 * 200.0 * cosine * 2.0 * cosine;
  CHECK(
      path->longer_m ==
      Approx(heights_m2 / (direct_m + std::sqrt(direct_m * direct_m + heights_m2))).epsilon(1e-9));
}

// On which plans rest: a shower beside the fan cannot count for the sake of a target in it.
TEST_CASE("Rain on the way by the ground alone takes nothing from a target", "[multipath]") {
  renderer::World world = flat_world(1500.0, 50.0, kMetal);
  // The plane leans to the east, so that it mirrors 8 m east of the straight way, 1200 m ahead.
  world.geometry =
      tests::geometry(tests::ground(4000.0, 250.0, [](double x_m, double) { return 0.1 * x_m; }));
  const auto dry = echoes(world, 200.0, Multipath::mean);
  REQUIRE(dry.size() > 1);
  const auto in_shower = [&](double east_m) {
    atmosphere::Weather weather;
    atmosphere::RainCell shower;
    shower.centre_m = {east_m, 1200.0};
    shower.radius_m = 3.0;
    shower.rain_rate_mm_per_h = 100.0;
    weather.rain_cells = {shower};
    world.rain_cells = atmosphere::RainCells(weather, 35e9);
    return echoes(world, 200.0, Multipath::mean);
  };
  const auto beside = in_shower(8.0), between = in_shower(0.0);
  REQUIRE(beside.size() == dry.size());
  for (std::size_t i = 0; i < dry.size(); ++i) {
    CHECK(beside[i].power_W == dry[i].power_W);
    CHECK(between[i].power_W < dry[i].power_W);
  }
}

TEST_CASE("Dark ground, rough ground or a blocked leg leave the direct echo as it was",
          "[multipath]") {
  const auto same = [](const renderer::World& world) {
    const std::vector<core::Echo> off = echoes(world, 60.0, Multipath::none);
    REQUIRE(off.size() == 1);
    for (const Multipath multipath : {Multipath::mean, Multipath::coherent}) {
      const std::vector<core::Echo> on = echoes(world, 60.0, multipath);
      REQUIRE(on.size() == 1);
      CHECK(std::memcmp(&on[0].power_W, &off[0].power_W, sizeof(double)) == 0);
      CHECK(on[0].range_m == off[0].range_m);
    }
  };
  same(flat_world(2000.0, 10.0, std::nullopt));
  same(flat_world(2000.0, 10.0, materials::SpecularSurface{{1.0, 0.0}, 0.0}));
  same(flat_world(2000.0, 10.0, materials::SpecularSurface{{5.0, 0.1}, 100.0}));
  // The reflection lies 286 m before the target; a low wall beyond it hides the target from it
  // but not from the sensor.
  same(
      flat_world(2000.0, 10.0, kMetal, {tests::box({-20.0, 1900.0, 0.0}, {20.0, 1901.0, 9.0}, 1)}));
  CHECK(gain(flat_world(2000.0, 10.0, kMetal), 60.0, Multipath::mean) == Approx(6.0).epsilon(0.01));
}

TEST_CASE("Multipath runs where point targets stand over ground that reflects",
          "[multipath][plan]") {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  const auto runs = [&](const char* wishes) {
    return renderer::plan(
               facts, 0.5,
               wishes == nullptr ? renderer::EffectWishes{} : renderer::parse_effect_wishes(wishes))
        .runs(core::EffectId::multipath);
  };
  facts.has_point_targets = true;
  facts.reflects = true;  // a wall does
  CHECK_FALSE(runs(nullptr));
  facts.ground_reflects = true;
  CHECK(runs(nullptr));
  CHECK_FALSE(runs("-multipath"));
  facts.has_point_targets = false;
  CHECK_FALSE(runs(nullptr));
}

TEST_CASE("A target that only side lobes light has its ground path as well", "[multipath]") {
  // The beam ends 0.5 deg from its axis at -3.8 deg; target and mirrored direction lie behind.
  renderer::World world = flat_world(2000.0, 10.0, kMetal);
  sensors::BeamCut& cut = world.sensor.antenna.elevation;
  cut.half_power_width_rad = 0.01;
  cut.cut_rad = 0.009;
  cut.side_lobe_gain = 1e-3;
  cut.side_lobe_extent_rad = 0.5;
  CHECK(total_W(echoes(world, 60.0, Multipath::none)) > 0.0);
  CHECK(gain(world, 60.0, Multipath::mean) == Approx(6.0).epsilon(0.01));
  // Down at the ground 60 m below and 1 km off, 3.4 deg, is the main beam: its target is lit by
  // side lobes directly, and by the beam's axis through the ground.
  world.targets[0].path[0].position_m = {0.0, 1000.0, 7.0};
  const auto path = renderer::ground_path(world, antenna_at(60.0), {0.0, 1000.0, 7.0});
  REQUIRE(path);
  const double axis_rad = world.sensor.antenna.boresight_elevation_rad;
  const double mirrored = sensors::one_way_gain(cut, path->elevation_rad - axis_rad);
  REQUIRE(mirrored > 0.5);
  CHECK(std::norm(path->amplitude) == Approx(mirrored / 1e-3).epsilon(0.02));
  cut.side_lobe_gain = 0.0;
  CHECK(echoes(world, 60.0, Multipath::mean).empty());
}

TEST_CASE("Frames show the mean without and a phase with a realisation", "[multipath]") {
  const double wave_m = tests::hivision().wavelength_m();
  const double null_m = height_for_m(1000.0, 60.0, 20.0 * wave_m);
  const double lobe_m = height_for_m(1000.0, 60.0, 20.5 * wave_m);
  // The target alone: ground that mirrors but scatters nothing, and no noise.
  const auto ratio = [](double height_m, bool speckle) {
    renderer::World world = flat_world(1000.0, height_m, kMetal);
    world.nrcs = std::vector<materials::NrcsCurve>(2, materials::PhongNrcs(0.0, 0.0, 1.0));
    world.sensor.receiver.looks = 1000;
    const core::EffectSet without = core::EffectSet{}.with(core::EffectId::speckle, speckle);
    return frame_W(world, {without.with(core::EffectId::multipath, true)}) /
           frame_W(world, {without});
  };
  for (const double height_m : {null_m, lobe_m})
    CHECK(ratio(height_m, false) == Approx(6.0).epsilon(0.01));
  CHECK(ratio(null_m, true) < 1e-4);
  CHECK(ratio(lobe_m, true) == Approx(16.0).epsilon(0.01));
}

TEST_CASE("In a realisation over speckled ground nulls are the ground alone, lobes stand out",
          "[multipath]") {
  const double wave_m = tests::hivision().wavelength_m();
  // Over the frames of many looks, against the same draws without the target.
  const auto target_W = [](double height_m, bool multipath) {
    renderer::World world = flat_world(1000.0, height_m, kMetal);
    world.targets[0].rcs = materials::ConstantRcs{100.0};
    world.sensor.receiver.looks = 1000;
    const renderer::Effects effects{
        core::EffectSet{core::EffectId::speckle}.with(core::EffectId::multipath, multipath)};
    const double with_W = frame_W(world, effects);
    world.targets.clear();
    return with_W - frame_W(world, effects);
  };
  const double null_m = height_for_m(1000.0, 60.0, 20.0 * wave_m);
  const double lobe_m = height_for_m(1000.0, 60.0, 20.5 * wave_m);
  const double free_W = target_W(lobe_m, false);
  CHECK(target_W(lobe_m, true) / free_W == Approx(16.0).epsilon(0.05));
  CHECK(std::abs(target_W(null_m, true)) < 0.05 * free_W);
}

TEST_CASE("Behind a scan all round the ground mirrors as it does ahead", "[multipath]") {
  renderer::World world = flat_world(3000.0, 2.0, kMetal);
  world.sensor.scan.field_of_view_rad = 2.0 * core::kPi;
  const auto ahead = renderer::ground_path(world, antenna_at(60.0), {0.0, 3000.0, 2.0});
  const auto behind = renderer::ground_path(world, antenna_at(60.0), {0.0, -3000.0, 2.0});
  REQUIRE(ahead);
  REQUIRE(behind);
  CHECK(behind->longer_m == Approx(ahead->longer_m).epsilon(1e-9));
  CHECK(behind->amplitude.real() == Approx(ahead->amplitude.real()).epsilon(1e-9));
  CHECK(behind->elevation_rad == Approx(ahead->elevation_rad).epsilon(1e-9));
}

// Dry snow scatters almost all that arrives; by its refraction alone it mirrored two thirds besides.
TEST_CASE("What the ground scatters it does not mirror", "[multipath]") {
  renderer::World world = flat_world(1000.0, 10.0, kMetal);
  world.nrcs = std::vector<materials::NrcsCurve>(
      2, materials::NrcsCurve(materials::PhongNrcs(1.6, 0.0, 1.0)));
  const auto path = renderer::ground_path(world, antenna_at(60.0), {0.0, 1000.0, 10.0});
  REQUIRE(path);
  const double image_m = std::hypot(1000.0, 70.0), direct_m = std::hypot(1000.0, 50.0);
  const double left = world.nrcs.bistatic()[0].unscattered(70.0 / image_m);
  CHECK(left < 0.5);
  CHECK(left > 0.01);
  CHECK(std::norm(path->amplitude) == Approx(left * std::pow(direct_m / image_m, 2)).epsilon(1e-3));
}
