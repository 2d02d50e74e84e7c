// Double bounce against closed forms of right-angled corners, and what it must leave alone.
#include "renderer/stages/double_bounce.h"

#include <catch2/catch.hpp>

#include "core/parallel.h"
#include "core/units.h"
#include "renderer/plan/plan.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display/grey_scale.h"
#include "tests/decibel.h"
#include "tests/renderer/usual_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using renderer::BounceEcho;
using renderer::BounceTracer;
using tests::antenna_at;
using tests::dB;
using tests::flat_ground;
using tests::kBlack;
using tests::kHeight_m;
using tests::kRough;
using tests::same_bytes;

namespace {

constexpr double kWall_m = 15.0;        // tall
constexpr double kDistance_m = 1000.0;  // slant range of the corner 1001.8 m, inside cell 120
constexpr int kCornerCell = 120;

// So weak that next to nothing is taken from what it mirrors.
const materials::PhongNrcs kFaint(0.00005, 0.0003, 3.0);
// Reflects all there is at every angle.
const materials::SpecularSurface kPolished{{1.0, 1e9}, 0.0};

// Faces south, towards the sensor of level_pose.
terrain::PlacedMesh wall(double y_m, double bottom_m, double top_m) {
  return tests::quad({glm::dvec3(-300.0, y_m, bottom_m), glm::dvec3(300.0, y_m, bottom_m),
                      glm::dvec3(300.0, y_m, top_m), glm::dvec3(-300.0, y_m, top_m)},
                     1);
}

// Ground 0 is a perfect black mirror, wall 1 a diffuse surface.
renderer::World corner_world(std::vector<tests::Body> screens = {}) {
  screens.push_back(wall(kDistance_m, 0.0, kWall_m));
  renderer::World world =
      tests::world(tests::hivision(12), flat_ground(), {kBlack, kRough}, std::move(screens));
  world.specular = {kPolished};
  return world;
}

renderer::Frame render(const renderer::World& world, const renderer::Sampling& sampling,
                       bool double_bounce, double height_m = kHeight_m) {
  const renderer::Effects effects{
      core::EffectSet{}.with(core::EffectId::double_bounce, double_bounce)};
  return renderer::render_frame(world, sampling, {}, effects, tests::level_pose(height_m));
}

// What the effect adds to each range cell, in the mean over the middle columns.
std::vector<double> added_W(const renderer::World& world, const renderer::Sampling& sampling) {
  const renderer::Frame with = render(world, sampling, true);
  const renderer::Frame without = render(world, sampling, false);
  const int columns = world.sensor.scan.columns;
  std::vector<double> added(static_cast<std::size_t>(world.sensor.range.cells), 0.0);
  for (int k = 0; k < world.sensor.range.cells; ++k)
    for (int c = columns / 3; c < columns - columns / 3; ++c)
      added[static_cast<std::size_t>(k)] +=
          (with.bscope_W[static_cast<std::size_t>(k * columns + c)] -
           without.bscope_W[static_cast<std::size_t>(k * columns + c)]) /
          (columns - 2 * (columns / 3));
  return added;
}

double one_way(const sensors::Sensor& sensor, double elevation_rad) {
  return sensors::one_way_gain(sensor.antenna.elevation,
                               elevation_rad - sensor.antenna.boresight_elevation_rad);
}

// The wall's point at height z, through the mirror of the ground: power per metre of wall height
// and radian of azimuth. The mirrored ray arrives from the sensor's image at -h.
struct Dihedral {
  double pair_W = 0.0, image_W = 0.0;
};
Dihedral dihedral_density(const sensors::Sensor& sensor, double z_m) {
  const double from_image_m = std::hypot(kDistance_m, kHeight_m + z_m);
  const double direct_m = std::hypot(kDistance_m, kHeight_m - z_m);
  const double sin_in = kDistance_m / from_image_m, sin_out = kDistance_m / direct_m;
  const double up = -std::atan((kHeight_m - z_m) / kDistance_m);
  const double down = -std::atan((kHeight_m + z_m) / kDistance_m);
  // Seen from the wall the image lies as far below the level as `down` says, the sensor above it.
  const double tilt_rad = (down - up) / 2;
  const double normal_on_half = std::cos(tilt_rad);
  const double step_rad_per_m = kDistance_m / (from_image_m * from_image_m);
  const double K = sensor.radar_constant_W_m2();
  return {4.0 * K * one_way(sensor, up) * one_way(sensor, down) * std::sqrt(sin_in * sin_out) /
              sin_in * kRough.sigma0(normal_on_half) / normal_on_half * step_rad_per_m /
              (direct_m * direct_m),
          K * std::pow(one_way(sensor, down), 2) * kRough.sigma0(sin_in) / sin_in * step_rad_per_m /
              (from_image_m * from_image_m)};
}

Dihedral dihedral_W(const sensors::Sensor& sensor) {
  constexpr int kSteps = 200;
  Dihedral sum;
  for (int i = 0; i < kSteps; ++i) {
    const Dihedral at = dihedral_density(sensor, (i + 0.5) * kWall_m / kSteps);
    const double weight = sensors::two_way_width(sensor.antenna.azimuth) * kWall_m / kSteps;
    sum.pair_W += at.pair_W * weight;
    sum.image_W += at.image_W * weight;
  }
  return sum;
}

}  // namespace

TEST_CASE("One ray by way of the ground has the range and the power of the closed form",
          "[bounce]") {
  const renderer::World world = corner_world();
  const BounceTracer tracer(world, false);
  const sensors::AntennaFrame antenna = antenna_at(kHeight_m);
  for (const double z_m : {0.5, 3.0, 7.0, 14.5}) {
    std::vector<BounceEcho> echoes;
    tracer.trace(antenna, {{0.0, -std::atan((kHeight_m + z_m) / kDistance_m)}}, 0,
                 terrain::Packing::alike, echoes);
    REQUIRE(echoes.size() == 2);
    if (echoes[0].range_m > echoes[1].range_m) std::swap(echoes[0], echoes[1]);
    const BounceEcho &pair = echoes[0], &image = echoes[1];
    const double from_image_m = std::hypot(kDistance_m, kHeight_m + z_m);
    const double direct_m = std::hypot(kDistance_m, kHeight_m - z_m);
    const double step_rad_per_m = kDistance_m / (from_image_m * from_image_m);
    const Dihedral expected = dihedral_density(world.sensor, z_m);
    CHECK(pair.range_m == Approx((from_image_m + direct_m) / 2).epsilon(0.0).margin(2e-3));
    CHECK(image.range_m == Approx(from_image_m).epsilon(0.0).margin(2e-3));
    CHECK(pair.density_W_per_rad2 == Approx(expected.pair_W / step_rad_per_m).epsilon(1e-3));
    CHECK(image.density_W_per_rad2 == Approx(expected.image_W / step_rad_per_m).epsilon(1e-3));
    CHECK(pair.azimuth_rad == Approx(0.0).epsilon(0.0).margin(1e-9));
  }
}

TEST_CASE("Behind a scan all round a corner returns what it returns ahead", "[bounce]") {
  constexpr double kUp_m = 7.0;
  const auto traced = [&](double bearing_deg) {
    const double bearing_rad = core::radians(bearing_deg);
    const glm::dvec3 away(std::sin(bearing_rad), std::cos(bearing_rad), 0.0);
    const glm::dvec3 right(away.y, -away.x, 0.0), up(0.0, 0.0, kWall_m);
    const glm::dvec3 left_m = kDistance_m * away - 300.0 * right;
    const glm::dvec3 right_m = kDistance_m * away + 300.0 * right;
    sensors::Sensor sensor = tests::hivision(12);
    sensor.scan.surface = sensors::ScanSurface::plane;
    sensor.scan.field_of_view_rad = 2.0 * core::kPi;
    renderer::World world =
        tests::world(sensor, flat_ground(), {kBlack, kRough},
                     {tests::quad({left_m, right_m, right_m + up, left_m + up}, 1)});
    world.specular = {kPolished};
    std::vector<BounceEcho> echoes;
    BounceTracer(world, false)
        .trace(antenna_at(kHeight_m),
               {{bearing_rad, -std::atan((kHeight_m + kUp_m) / kDistance_m)}}, 0,
               terrain::Packing::alike, echoes);
    if (echoes.size() == 2 && echoes[0].range_m > echoes[1].range_m)
      std::swap(echoes[0], echoes[1]);
    return echoes;
  };
  const std::vector<BounceEcho> ahead = traced(0.0);
  REQUIRE(ahead.size() == 2);
  for (const double bearing_deg : {60.0, 120.0, -120.0, 180.0}) {
    const std::vector<BounceEcho> there = traced(bearing_deg);
    INFO("bearing " << bearing_deg);
    REQUIRE(there.size() == 2);
    for (const std::size_t i : {0U, 1U}) {
      CHECK(there[i].range_m == Approx(ahead[i].range_m).epsilon(0.0).margin(4e-3));
      CHECK(there[i].azimuth_rad == Approx(core::radians(bearing_deg)).epsilon(0.0).margin(1e-5));
      CHECK(there[i].density_W_per_rad2 == Approx(ahead[i].density_W_per_rad2).epsilon(2e-3));
    }
  }
}

TEST_CASE("A wall on smooth ground: the corner's cell gains the power of the closed form",
          "[bounce]") {
  const renderer::World world = corner_world();
  REQUIRE(sensors::range_row(world.sensor.range, std::hypot(kDistance_m, kHeight_m)) ==
          kCornerCell);
  const Dihedral expected = dihedral_W(world.sensor);
  renderer::Sampling reference = renderer::reference_sampling(1);
  reference.jittered_passes = 4;
  for (const renderer::Sampling& sampling : {reference, renderer::sampling_for(4.0)}) {
    const std::vector<double> added = added_W(world, sampling);
    double total_W = 0.0;
    for (const double value : added) total_W += value;
    CHECK(dB(total_W / (expected.pair_W + expected.image_W)) ==
          Approx(0.0).epsilon(0.0).margin(sampling.jittered_passes > 0 ? 0.1 : 0.5));
    CHECK(added[kCornerCell] > 0.999 * total_W);
  }
}

// The ground mirrors up to 200 m before the wall.
TEST_CASE("Mirrors nearer than the first range cell count", "[bounce]") {
  renderer::Sampling reference = renderer::reference_sampling(1);
  reference.jittered_passes = 4;
  for (const double gate_m : {700.0, 900.0, 990.0})
    for (const renderer::Sampling& sampling : {reference, renderer::sampling_for(4.0)}) {
      renderer::World world = corner_world();
      world.sensor.range.minimum_m = gate_m;
      world.sensor.range.cells = 100;
      const Dihedral expected = dihedral_W(world.sensor);
      double total_W = 0.0;
      for (const double value : added_W(world, sampling)) total_W += value;
      CAPTURE(gate_m, sampling.jittered_passes);
      CHECK(dB(total_W / (expected.pair_W + expected.image_W)) ==
            Approx(0.0).epsilon(0.0).margin(sampling.jittered_passes > 0 ? 0.1 : 0.3));
    }
}

TEST_CASE("An inner corner of two walls seen at 45 deg returns in the corner's cell", "[bounce]") {
  // Two polished and rough walls of length 8 m meet at a right angle at (0, D) and open towards the
  // sensor, which looks level at their middle height. No ground.
  constexpr double kLength_m = 8.0, kTall_m = 4.0;
  const double reach_m = kLength_m / std::sqrt(2.0);
  const double z_m = kHeight_m - kDistance_m * std::tan(core::radians(3.8));
  const glm::dvec3 low(0.0, kDistance_m, z_m - kTall_m / 2), high = low + glm::dvec3(0, 0, kTall_m);
  const glm::dvec3 left(-reach_m, -reach_m, 0.0), right(reach_m, -reach_m, 0.0);
  renderer::World world = tests::world(tests::hivision(16), std::nullopt, {kFaint},
                                       {tests::quad({low + left, low, high, high + left}, 0),
                                        tests::quad({low, low + right, high + right, high}, 0)});
  world.specular = {kPolished};
  const sensors::Sensor& sensor = world.sensor;

  // By symmetry twice the route that ends on the right wall, at distance s from the corner. Levels
  // differ by little: the fall of the rays, 3.8 deg, is kept in lengths and sines.
  const double depression = core::radians(3.8);
  const double slant = 1.0 / std::cos(depression);
  double pair_W = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double s_m = (i + 0.5) * kLength_m / kSteps;
    const double turned = std::sqrt(2.0) * kDistance_m * s_m;
    const double flat_in_m = std::sqrt(kDistance_m * kDistance_m + s_m * s_m + turned);
    const double flat_out_m = std::sqrt(kDistance_m * kDistance_m + s_m * s_m - turned);
    const double in_m = flat_in_m * slant, out_m = flat_out_m * slant;
    const double sin_in = kDistance_m / std::sqrt(2.0) / in_m;
    const double sin_out = kDistance_m / std::sqrt(2.0) / out_m;
    // The half vector of an inner corner is its normal, but for the fall that both share.
    const double normal_on_half = std::cos(depression);
    const double azimuth_rad = std::atan2(s_m / std::sqrt(2.0), kDistance_m);
    pair_W += 2.0 * 4.0 * sensor.radar_constant_W_m2() *
              sensors::two_way_gain(sensor.antenna.azimuth, azimuth_rad) *
              std::sqrt(sin_in * sin_out) * kFaint.sigma0(normal_on_half) / normal_on_half *
              kTall_m * kLength_m / kSteps / (in_m * in_m * out_m * out_m);
  }
  pair_W *= sensors::two_way_width(sensor.antenna.azimuth) / sensor.scan.column_width_rad();

  renderer::Sampling fine = renderer::sampling_for(400.0);
  fine.largest_step_rad = 5e-5;
  const renderer::Frame with = render(world, fine, true);
  const renderer::Frame without = render(world, fine, false);
  double total_W = 0.0, nearer_W = 0.0;
  const int corner = sensors::range_row(sensor.range, kDistance_m * slant);
  for (int k = 0; k < sensor.range.cells; ++k)
    for (int c = 0; c < sensor.scan.columns; ++c) {
      const auto i = static_cast<std::size_t>(k * sensor.scan.columns + c);
      const double added = with.bscope_W[i] - without.bscope_W[i];
      REQUIRE(added >= 0.0);
      if (k == corner) total_W += added;
      if (k < corner) nearer_W += added;
    }
  CHECK(nearer_W == 0.0);
  // The image of the opposite wall, seen twice through the mirror, lies farther off and partly in
  // the same cell: at most a tenth.
  CHECK(total_W > 0.89 * pair_W);
  CHECK(total_W < 1.25 * pair_W);
}

TEST_CASE("An occluded corner gives nothing", "[bounce]") {
  const std::size_t cell = kCornerCell;
  const renderer::Sampling sampling = renderer::sampling_for(16.0);
  const double open_W = added_W(corner_world(), sampling)[cell];
  REQUIRE(open_W > 0.0);
  // Down to the ground: neither way is left.
  CHECK(added_W(corner_world({wall(700.0, 0.0, 40.0)}), sampling)[cell] == 0.0);
  // Hanging: rays still reach the wall by the ground (below 12 m there) and may return that way
  // alone, but the wall no longer sees the sensor (above 12 m there).
  const renderer::World hanging = corner_world({wall(800.0, 12.01, 40.0)});
  const double image_W = added_W(hanging, sampling)[cell];
  CHECK(dB(image_W / dihedral_W(hanging.sensor).image_W) == Approx(0.0).epsilon(0.0).margin(0.5));
}

TEST_CASE("A rain cell takes from a bounce what it takes from a direct echo", "[bounce]") {
  renderer::World world = corner_world();
  const double dry_W = added_W(world, renderer::sampling_for(4.0))[kCornerCell];
  atmosphere::Weather weather;
  weather.rain_cells = {{.radius_m = 50000.0, .rain_rate_mm_per_h = 20.0, .base_m = -100.0}};
  world.rain_cells.emplace(weather, world.sensor.waveform.frequency_Hz);
  const double wet_W = added_W(world, renderer::sampling_for(4.0))[kCornerCell];
  // Every way by the corner is twice its slant range long, within a metre.
  const double range_m = std::hypot(kDistance_m, kHeight_m);
  const double two_way_dB =
      2.0 * world.rain_cells->one_way_dB({0.0, 0.0, kHeight_m}, {0.0, range_m, kHeight_m});
  CHECK(two_way_dB > 5.0);
  CHECK(10.0 * std::log10(dry_W / wet_W) == Approx(two_way_dB).epsilon(0.0).margin(0.02));
}

TEST_CASE("Nothing that reflects: the effect changes no byte", "[bounce]") {
  renderer::World world = corner_world();
  const renderer::Sampling sampling = renderer::sampling_for(4.0);
  const renderer::Frame off = render(world, sampling, false);
  // No surface at all, no boundary (permittivity 1), and a surface too rough to mirror.
  for (const std::vector<std::optional<materials::SpecularSurface>>& specular :
       {std::vector<std::optional<materials::SpecularSurface>>{},
        {materials::SpecularSurface{{1.0, 0.0}, 0.0}},
        {materials::SpecularSurface{{5.0, 0.1}, 10.0}}}) {
    world.specular = specular;
    const renderer::Frame on = render(world, sampling, true);
    CHECK(same_bytes(on.bscope_W, off.bscope_W));
    CHECK(same_bytes(on.cscope_W_m3, off.cscope_W_m3));
  }
  world.specular = {kPolished};
  CHECK_FALSE(same_bytes(render(world, sampling, true).bscope_W, off.bscope_W));
}

TEST_CASE("Double bounce gives the same bytes on any number of threads", "[bounce]") {
  // Walls at odd angles, so that mirrored rays come back in other columns.
  std::vector<tests::Body> bodies;
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 at(-60.0 + 22.0 * i, 700.0 + 60.0 * i, 0.0);
    const double turn = 0.5 * i;
    const glm::dvec3 along(12.0 * std::cos(turn), 12.0 * std::sin(turn), 0.0), up(0.0, 0.0, 9.0);
    bodies.push_back(tests::quad({at, at + along, at + along + up, at + up}, 1));
    bodies.push_back(tests::quad({at + up, at + along + up, at + along, at}, 1));
  }
  renderer::World world =
      tests::world(tests::hivision(24), flat_ground(), {kRough, kRough}, std::move(bodies));
  world.specular = {kPolished, kPolished};
  std::vector<renderer::Frame> frames;
  for (const int threads : {1, 2, 5}) {
    const core::ThreadLimit limit(threads);
    frames.push_back(render(world, renderer::sampling_for(8.0), true));
  }
  for (const renderer::Frame& frame : frames) {
    CHECK(same_bytes(frame.bscope_W, frames.front().bscope_W));
    CHECK(same_bytes(frame.cscope_W_m3, frames.front().cscope_W_m3));
    CHECK(frame.rays == frames.front().rays);
  }
}

TEST_CASE("A mirror too faint for any cut-off by its strength still shows an echo in shadow",
          "[bounce]") {
  // The ground keeps 1e-4 of the power: under -40 dB, yet the wall's mirrored echo appears where
  // without it a black cell is, far above the display's floor.
  renderer::World world = corner_world();
  const double sine = (kHeight_m + kWall_m / 2) / std::hypot(kDistance_m, kHeight_m);
  const double k_per_m = 2.0 * core::kPi / world.sensor.wavelength_m();
  world.specular = {
      materials::SpecularSurface{{1.0, 1e9}, std::sqrt(std::log(1e4)) / (2.0 * k_per_m * sine)}};
  const std::vector<double> added = added_W(world, renderer::sampling_for(16.0));
  CHECK(added[kCornerCell] > 10.0 * sensors::GreyScale(world.sensor).bscope_floor_W(kCornerCell));
}

TEST_CASE("Double bounce runs where mirrored rays may meet something", "[bounce][plan]") {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  const auto runs = [&](const char* wishes) {
    return renderer::plan(
               facts, 0.5,
               wishes == nullptr ? renderer::EffectWishes{} : renderer::parse_effect_wishes(wishes))
        .runs(core::EffectId::double_bounce);
  };
  CHECK_FALSE(runs(nullptr));
  facts.mirrored_rays_end = true;
  CHECK_FALSE(runs(nullptr));
  CHECK_FALSE(runs("+double-bounce"));
  facts.reflects = true;
  CHECK(runs(nullptr));
  CHECK_FALSE(runs("-double-bounce"));
  facts.mirrored_rays_end = false;
  CHECK_FALSE(runs(nullptr));
}
