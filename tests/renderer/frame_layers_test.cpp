// Ground truth of a plain with one wall on it, where every figure is known in closed form.
#include "renderer/stages/frame_layers.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "core/parallel.h"
#include "core/units.h"
#include "renderer/plan/largest_echo.h"
#include "sensors/cells.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;

namespace {

constexpr double kAntennaHeight_m = 100.0, kFront_m = 1000.0, kBack_m = 1020.0, kTop_m = 20.0;
constexpr terrain::ObjectId kShed = 3;
const materials::PhongNrcs kBright(1.0, 1.0, 1.0);

// Something in every azimuth that slices cannot show: a box around nothing.
void leave_to_rays(renderer::World& world) {
  tests::solids_of(world).others.push_back({{-5e3, -5e3, -10.0}, {5e3, 5e3, 100.0}});
}

renderer::World plain_with_shed(const sensors::Sensor& sensor) {
  tests::Body shed = tests::box({-200.0, kFront_m, -2.0}, {200.0, kBack_m, kTop_m}, 1);
  shed.mesh.object_of_part = {kShed};
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {kGrass, kBright}, {shed});
  const_cast<std::vector<std::string>&>(world.geometry->object_names) = {"terrain", "a", "b",
                                                                         "shed"};
  return world;
}

renderer::Frame rendered(const renderer::World& world, const renderer::Sampling& sampling,
                         const renderer::Effects& effects = {},
                         const renderer::Products& wanted = {.layers = true,
                                                             .cscope_layers = true}) {
  return renderer::render_frame(world, sampling, wanted, effects,
                                tests::level_pose(kAntennaHeight_m));
}

constexpr int kLayerColumns = 8;
std::size_t at(int row, int column = 3) {
  return static_cast<std::size_t>(row * kLayerColumns + column);
}

// Slant range where the line of sight over the shed's far top edge comes down.
double shadow_ends_m() {
  return std::hypot(kBack_m * kAntennaHeight_m / (kAntennaHeight_m - kTop_m), kAntennaHeight_m);
}

}  // namespace

TEST_CASE("Layers tell a plain and a shed as they are", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  renderer::World world = plain_with_shed(sensor);
  if (GENERATE(false, true)) leave_to_rays(world);
  const renderer::Frame frame = rendered(world, renderer::sampling_for(4.0));
  REQUIRE(frame.layers);
  const renderer::LayerSet& truth = frame.layers->bscope;
  const double wall_near_m = std::hypot(kFront_m, kAntennaHeight_m - kTop_m);
  const double wall_far_m = std::hypot(kFront_m, kAntennaHeight_m);
  const double step_m = 2.0 * sensor.range.cell_m;  // of the rays
  int ground = 0, wall = 0, dark = 0;
  for (int row = 0; row < sensor.range.cells; ++row) {
    const double near_m = sensors::range_edge_m(sensor.range, row);
    const double far_m = sensors::range_edge_m(sensor.range, row + 1);
    const std::size_t i = at(row);
    INFO("cell " << near_m << " to " << far_m);
    // The beam ends at -19.4 deg, 301 m away.
    if (near_m < 320.0) continue;
    if (far_m < wall_near_m - step_m || near_m > shadow_ends_m() + step_m) {
      ++ground;
      REQUIRE(truth.visibility[i] == 1.0F);
      REQUIRE(truth.material[i] == 0);
      REQUIRE(truth.object[i] == terrain::kTerrainObject);
      const double least = kAntennaHeight_m / far_m, most = kAntennaHeight_m / near_m;
      const auto between = [](double value, double low, double high) {
        return value >= low * 0.9999 && value <= high * 1.0001;
      };
      REQUIRE(between(std::sin(static_cast<double>(truth.grazing_rad[i])), least, most));
      REQUIRE(between(-std::sin(static_cast<double>(truth.elevation_rad[i])), least, most));
      REQUIRE(
          between(static_cast<double>(truth.nrcs[i]), kGrass.sigma0(least), kGrass.sigma0(most)));
    } else if (near_m < wall_far_m && far_m > wall_near_m) {
      ++wall;
      REQUIRE(truth.object[i] == kShed);
      REQUIRE(truth.material[i] == 1);
      REQUIRE(truth.visibility[i] == 1.0F);
    } else if (near_m > std::hypot(kBack_m, kAntennaHeight_m - kTop_m) &&
               far_m < shadow_ends_m() - sensor.range.cell_m) {
      ++dark;
      REQUIRE(truth.visibility[i] == 0.0F);
      REQUIRE(truth.material[i] == renderer::kNoMaterial);
      REQUIRE(truth.nrcs[i] == 0.0F);
    }
    REQUIRE(truth.double_bounce[i] == 0.0F);
  }
  CHECK(ground > 400);
  CHECK(wall >= 1);
  CHECK(dark > 30);
}

TEST_CASE("Layers of the C-scope tell how far each elevation sees", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  renderer::World world = plain_with_shed(sensor);
  if (GENERATE(false, true)) leave_to_rays(world);
  const renderer::Frame frame = rendered(world, renderer::profile_sampling_for(2.0));
  const renderer::LayerSet& truth = frame.layers->cscope;
  const double top_rad = -std::atan((kAntennaHeight_m - kTop_m) / kBack_m);
  const double foot_rad = -std::atan(kAntennaHeight_m / kFront_m);
  int ground = 0, wall = 0;
  for (int row = 0; row < sensor.display.cscope_rows; ++row) {
    const double high_rad =
        sensor.display.cscope_top_rad - sensors::cscope_edge_rad(sensor.display, row);
    const double low_rad =
        sensor.display.cscope_top_rad - sensors::cscope_edge_rad(sensor.display, row + 1);
    const std::size_t i = at(row);
    INFO("row " << core::degrees(low_rad) << " to " << core::degrees(high_rad));
    const double step_rad = 0.0015;  // of the rays around the shed
    const bool above = low_rad > top_rad + step_rad, below = high_rad < foot_rad - step_rad;
    // The ground ends with the range window, and the beam at -19.4 deg.
    if (high_rad > -std::asin(kAntennaHeight_m / (sensor.range.maximum_m() - 50.0)) ||
        low_rad < -0.33)
      continue;
    REQUIRE(truth.visibility[i] == 1.0F);
    if (above || below) {
      ++ground;
      REQUIRE(truth.object[i] == terrain::kTerrainObject);
      const double range_m = static_cast<double>(truth.range_m[i]);
      REQUIRE(range_m >= kAntennaHeight_m / std::sin(-low_rad) * 0.9999);
      REQUIRE(range_m <= kAntennaHeight_m / std::sin(-high_rad) * 1.0001);
    } else if (high_rad < -std::atan((kAntennaHeight_m - kTop_m) / kFront_m) &&
               low_rad > foot_rad) {
      ++wall;
      REQUIRE(truth.object[i] == kShed);
      REQUIRE(truth.range_m[i] >
              static_cast<float>(std::hypot(kFront_m, kAntennaHeight_m - kTop_m)) - 0.1F);
      REQUIRE(truth.range_m[i] < static_cast<float>(std::hypot(kFront_m, kAntennaHeight_m)) + 0.1F);
    }
  }
  CHECK(ground > 100);
  CHECK(wall > 30);
}

// In the left half of a column a near wall, in the right half a far one: of less power, but of more
// where it counts with R^3.
TEST_CASE("In the C-scope's truth power counts with the cube of the range", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  const double middle_rad = sensors::column_middle_rad(sensor.scan, 3);
  constexpr double kNear_m = 500.0, kFar_m = 2000.0;
  std::vector<tests::Body> walls;
  walls.push_back(tests::box({-200.0, kNear_m, -2.0},
                             {kNear_m * std::tan(middle_rad), kNear_m + 10.0, 95.0}, 0));
  walls.push_back(tests::box({-200.0, kFar_m, -2.0}, {200.0, kFar_m + 10.0, 90.0}, 1));
  for (std::size_t k = 0; k < 2; ++k)
    walls[k].mesh.object_of_part = {static_cast<terrain::ObjectId>(k + 1)};
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {kGrass, kBright}, walls);
  if (GENERATE(false, true)) leave_to_rays(world);
  REQUIRE(kGrass.sigma0(1.0) / (kNear_m * kNear_m) > kBright.sigma0(1.0) / (kFar_m * kFar_m));
  const renderer::LayerSet truth = rendered(world, renderer::sampling_for(4.0)).layers->cscope;
  for (const double elevation_deg : {-2.5, -2.0, -1.5, -1.0}) {
    INFO(elevation_deg << " deg");
    const int row = sensors::cscope_row(sensor.display, core::radians(elevation_deg));
    CHECK(truth.object[at(row)] == 2);
    CHECK(truth.material[at(row)] == 1);
    CHECK(truth.range_m[at(row)] > 1900.0F);
    CHECK(static_cast<double>(truth.nrcs[at(row)]) > 0.9 * kBright.sigma0(1.0));
  }
}

TEST_CASE("Roads two cells wide across the view are told in every column", "[frame_layers]") {
  constexpr terrain::ObjectId kRoad = 5;
  constexpr double kWide_m = 14.0;
  std::vector<terrain::SurfacePatch> roads;
  for (int road = 0; road < 12; ++road) {
    roads.push_back(
        terrain::rectangle_patch({0.0, 1000.0 + 170.0 * road}, {1.0, 0.0}, 3000.0, kWide_m, 1));
    roads.back().object = kRoad;
  }
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {kGrass, kBright}, {}, roads);
  if (GENERATE(false, true)) leave_to_rays(world);
  const renderer::LayerSet truth =
      rendered(world, renderer::profile_sampling_for(2.0)).layers->bscope;
  int cells = 0;
  for (int road = 0; road < 12; ++road)
    for (int column = 0; column < kLayerColumns; ++column)
      for (int row = 0; row < sensor.range.cells; ++row) {
        // Straight ahead; a degree beside they lie 0.15 m farther in a thousand.
        const auto north_m = [&](int edge) {
          const double range_m = sensors::range_edge_m(sensor.range, edge);
          return std::sqrt(range_m * range_m - kAntennaHeight_m * kAntennaHeight_m);
        };
        const double middle_m = 1000.0 + 170.0 * road, slack_m = 0.7;
        if (north_m(row) < middle_m - kWide_m / 2.0 + slack_m ||
            north_m(row + 1) > middle_m + kWide_m / 2.0 - slack_m)
          continue;
        INFO("road " << road << ", column " << column);
        REQUIRE(truth.material[at(row, column)] == 1);
        REQUIRE(truth.object[at(row, column)] == kRoad);
        REQUIRE(truth.nrcs[at(row, column)] > 3e-2F);
        ++cells;
      }
  CHECK(cells >= 12 * kLayerColumns / 2);
}

TEST_CASE("What lies beyond the range gate is in neither scope", "[frame_layers]") {
  sensors::Sensor sensor = tests::hivision(kLayerColumns);
  sensor.range.minimum_m = 600.0;
  sensor.range.cells = 200;
  renderer::World world = plain_with_shed(sensor);
  if (GENERATE(false, true)) leave_to_rays(world);
  const renderer::Frame frame = rendered(world, renderer::sampling_for(4.0));
  int lit = 0;
  for (int row = 0; row < sensor.display.cscope_rows; ++row) {
    const double high_rad =
        sensor.display.cscope_top_rad - sensors::cscope_edge_rad(sensor.display, row);
    const double low_rad =
        sensor.display.cscope_top_rad - sensors::cscope_edge_rad(sensor.display, row + 1);
    INFO("row " << core::degrees(low_rad) << " to " << core::degrees(high_rad));
    const bool near = high_rad < -std::asin(kAntennaHeight_m / sensor.range.minimum_m);
    const bool far = low_rad > -std::asin(kAntennaHeight_m / sensor.range.maximum_m());
    const float seen = frame.layers->cscope.visibility[at(row)];
    if (near || far) REQUIRE(seen == 0.0F);
    const double one_rad = high_rad - low_rad;
    if (high_rad < -std::asin(kAntennaHeight_m / sensor.range.maximum_m()) - one_rad &&
        low_rad > -std::asin(kAntennaHeight_m / sensor.range.minimum_m) + one_rad) {
      ++lit;
      REQUIRE(seen == 1.0F);
    }
  }
  CHECK(lit > 100);
}

TEST_CASE("Rays and slices, and any number of threads, give one truth", "[frame_layers][threads]") {
  const renderer::World world = plain_with_shed(tests::hivision(kLayerColumns));
  const renderer::Frame by_rays = rendered(world, renderer::sampling_for(4.0));
  const core::ThreadLimit one(1);
  const renderer::Frame by_slices = rendered(world, renderer::profile_sampling_for(4.0));
  for (const auto& [a, b] : {std::pair(by_rays.layers->bscope, by_slices.layers->bscope),
                             std::pair(by_rays.layers->cscope, by_slices.layers->cscope)}) {
    CHECK(a.visibility == b.visibility);
    CHECK(a.range_m == b.range_m);
    CHECK(a.grazing_rad == b.grazing_rad);
    CHECK(a.nrcs == b.nrcs);
    CHECK(a.elevation_rad == b.elevation_rad);
    CHECK(a.material == b.material);
    CHECK(a.object == b.object);
  }
}

TEST_CASE("Asking for layers changes no picture, and not asking makes none", "[frame_layers]") {
  const renderer::World world = plain_with_shed(tests::hivision(kLayerColumns));
  const renderer::Frame with = rendered(world, renderer::profile_sampling_for(4.0), {},
                                        {.layers = true, .cscope_layers = true});
  const renderer::Frame without = rendered(world, renderer::profile_sampling_for(4.0), {}, {});
  CHECK(with.bscope_W == without.bscope_W);
  CHECK(with.cscope_W_m3 == without.cscope_W_m3);
  CHECK_FALSE(without.layers);
  const renderer::Frame bscope_alone =
      rendered(world, renderer::profile_sampling_for(4.0), {}, {.layers = true});
  CHECK(bscope_alone.layers->cscope.visibility.empty());
  const renderer::LayerSet &a = bscope_alone.layers->bscope, &b = with.layers->bscope;
  CHECK(a.visibility == b.visibility);
  CHECK(a.grazing_rad == b.grazing_rad);
  CHECK(a.material == b.material);
  CHECK(a.elevation_rad == b.elevation_rad);
}

TEST_CASE("A point target brighter than the ground gives its number", "[frame_layers]") {
  renderer::World world = plain_with_shed(tests::hivision(kLayerColumns));
  for (const double north_m : {600.0, 2000.0})
    world.targets.push_back(
        {.name = "post", .rcs = materials::ConstantRcs{1e4}, .path = {{0.0, {0.5, north_m, 5.0}}}});
  const renderer::Frame frame = rendered(world, renderer::sampling_for(4.0));
  const sensors::Sensor& sensor = world.sensor;
  for (const std::size_t k : {0U, 1U}) {
    const glm::dvec3 to_m =
        world.targets[k].path[0].position_m - glm::dvec3(0.0, 0.0, kAntennaHeight_m);
    const int row = sensors::range_row(sensor.range, glm::length(to_m));
    const int column = sensors::azimuth_column(sensor.scan, std::atan2(to_m.x, to_m.y));
    CHECK(frame.layers->bscope.object[at(row, column)] == 4 + k);
    CHECK(frame.layers->bscope.material[at(row, column)] == renderer::kNoMaterial);
    CHECK(frame.layers->bscope.object[at(row, column - 1)] == terrain::kTerrainObject);
    const int elevation_row =
        sensors::cscope_row(sensor.display, std::atan2(to_m.z, std::hypot(to_m.x, to_m.y)));
    // The nearer one lies below the C-scope.
    CHECK((elevation_row == sensors::kOutside) == (k == 0));
    if (elevation_row != sensors::kOutside)
      CHECK(frame.layers->cscope.object[at(elevation_row, column)] == 4 + k);
  }
}

TEST_CASE("A point target counts from the power of its cell's ground on", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  for (const double range_m : {700.0, 1200.0, 2100.0, 3300.0})
    for (const double over_ground : {0.8, 1.25}) {
      renderer::World world = plain_with_shed(sensor);
      world.geometry =
          tests::geometry(tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }));
      // In the middle of a cell, whose ground sends as this does.
      const int row = sensors::range_row(sensor.range, range_m);
      const double middle_m = sensors::range_middle_m(sensor.range, row);
      const double sine = kAntennaHeight_m / middle_m, cosine = std::sqrt(1.0 - sine * sine);
      const double ground_m2 = kGrass.sigma0(sine) * renderer::azimuth_width_rad(sensor) *
                               middle_m * sensor.range.cell_m / cosine;
      const double azimuth_rad = sensors::column_middle_rad(sensor.scan, 3);
      world.targets.push_back({.name = "post",
                               .rcs = materials::ConstantRcs{over_ground * ground_m2},
                               .path = {{0.0,
                                         {middle_m * cosine * std::sin(azimuth_rad),
                                          middle_m * cosine * std::cos(azimuth_rad), 1.0}}}});
      const renderer::Frame frame = rendered(world, renderer::sampling_for(4.0));
      INFO(middle_m << " m, " << over_ground << " of the ground");
      const bool target = frame.layers->bscope.material[at(row)] == renderer::kNoMaterial;
      CHECK(target == (over_ground > 1.0));
    }
}

TEST_CASE("Low walls that hide next to nothing are told in every column", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  std::vector<tests::Body> walls;
  for (double front_m = 1300.0; front_m < 3000.0; front_m += 140.0) {
    walls.push_back(tests::box({-200.0, front_m, -2.0}, {200.0, front_m + 4.0, 2.0}, 1));
    walls.back().mesh.object_of_part = {kShed};
  }
  renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {kGrass, kBright}, walls);
  if (GENERATE(false, true)) leave_to_rays(world);
  const renderer::LayerSet truth = rendered(world, renderer::sampling_for(4.0)).layers->bscope;
  for (double front_m = 1300.0; front_m < 3000.0; front_m += 140.0)
    for (int column = 0; column < kLayerColumns; ++column) {
      INFO("wall at " << front_m << " m, column " << column);
      const int row = sensors::range_row(sensor.range, std::hypot(front_m, kAntennaHeight_m));
      const bool told =
          truth.object[at(row, column)] == kShed || truth.object[at(row + 1, column)] == kShed;
      CHECK(told);
    }
}

TEST_CASE("Where a wall stands on a mirror most of the power bounces twice", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  renderer::World world = plain_with_shed(sensor);
  world.specular = {materials::SpecularSurface{{1.0, 1e9}, 0.0},
                    materials::SpecularSurface{{1.0, 1e9}, 0.0}};
  const int corner = sensors::range_row(sensor.range, std::hypot(kFront_m, kAntennaHeight_m));
  const renderer::Effects bounces{{core::EffectId::double_bounce}};
  for (const renderer::Sampling& sampling :
       {renderer::profile_sampling_for(4.0),
        renderer::refined_sampling(renderer::CasterKind::profile, 1.0)}) {
    const renderer::LayerSet truth = rendered(world, sampling, bounces).layers->bscope;
    CHECK(truth.double_bounce[at(corner)] > 0.5F);
    CHECK(truth.double_bounce[at(corner - 20)] == 0.0F);
    CHECK(*std::max_element(truth.double_bounce.begin(), truth.double_bounce.end()) <= 1.0F);
  }
}

// What the wall hides gets echoes by the ground alone: whatever the sampling, all of it is bounces.
TEST_CASE("Where bounces are all there is their share is one at any sampling", "[frame_layers]") {
  const sensors::Sensor sensor = tests::hivision(kLayerColumns);
  renderer::World world = plain_with_shed(sensor);
  world.specular = {materials::SpecularSurface{{1.0, 1e9}, 0.0},
                    materials::SpecularSurface{{1.0, 1e9}, 0.0}};
  const renderer::Effects bounces{{core::EffectId::double_bounce}};
  using renderer::CasterKind;
  for (const renderer::Sampling& sampling :
       {renderer::profile_sampling_for(4.0), renderer::sampling_for(4.0),
        renderer::refined_sampling(CasterKind::profile, 0.25),
        renderer::refined_sampling(CasterKind::rays, 0.25)}) {
    const renderer::Frame frame = rendered(world, sampling, bounces);
    const renderer::LayerSet& truth = frame.layers->bscope;
    const int first = sensors::range_row(sensor.range, std::hypot(kBack_m, kAntennaHeight_m)) + 2;
    const int last = sensors::range_row(sensor.range, shadow_ends_m()) - 2;
    INFO("accuracy " << sampling.target_grey << ", slices " << frame.slices);
    int lit = 0;
    for (int row = first; row < last; ++row) {
      if (!(frame.bscope_W[at(row)] > 0.0)) continue;
      ++lit;
      CHECK(truth.double_bounce[at(row)] == Approx(1.0F).epsilon(1e-6));
    }
    CHECK(lit > 5);
  }
}

TEST_CASE("Rays tell all of a plain as lit, whatever the number of range cells", "[frame_layers]") {
  for (const int cells : {1, 2, 5, 11, 16, 18, 24}) {
    sensors::Sensor sensor = tests::hivision(kLayerColumns);
    sensor.range.minimum_m = 400.0;
    sensor.range.cells = cells;
    renderer::World world = tests::world(
        sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }), {kGrass, kBright});
    leave_to_rays(world);
    const renderer::LayerSet truth = rendered(world, renderer::sampling_for(4.0)).layers->bscope;
    INFO(cells << " cells");
    CHECK(*std::min_element(truth.visibility.begin(), truth.visibility.end()) == 1.0F);
    CHECK(*std::min_element(truth.nrcs.begin(), truth.nrcs.end()) > 0.0F);
  }
}

// Of a rolled antenna every column has a horizon of its own.
TEST_CASE("All of a plain is lit for a rolled antenna", "[frame_layers]") {
  sensors::Sensor sensor = tests::hivision(160);
  sensor.scan.stabilised = false;
  const renderer::World world = tests::world(
      sensor, tests::ground(5000.0, 50.0, [](double, double) { return 0.0; }), {kGrass, kBright});
  renderer::FramePose pose = tests::level_pose(60.0);
  pose.q_NB = pose.q_NB * glm::angleAxis(core::radians(30.0), glm::dvec3(1.0, 0.0, 0.0));
  const renderer::Frame frame =
      renderer::render_frame(world, renderer::sampling_for(4.0), {.layers = true}, {}, pose);
  int lit = 0, dark = 0;
  // Nearer, some columns look below their elevation pattern.
  for (std::size_t i = 160U * 60U; i < frame.bscope_W.size(); ++i) {
    if (!(frame.bscope_W[i] > 0.0)) continue;
    ++(frame.layers->bscope.visibility[i] == 1.0F ? lit : dark);
  }
  INFO(dark << " of " << lit + dark);
  CHECK(lit > 40000);
  CHECK(dark == 0);
}

TEST_CASE("In rain with bounces a frame has the same bytes with layers and with an estimate",
          "[frame_layers]") {
  renderer::World world = plain_with_shed(tests::hivision(kLayerColumns));
  world.specular = {materials::SpecularSurface{{1.0, 1e9}, 0.0},
                    materials::SpecularSurface{{1.0, 1e9}, 0.0}};
  atmosphere::Weather weather;
  weather.rain_rate_mm_per_h = 10.0;
  weather.rain_top_m = 12000.0;
  world.volume_echo.emplace(weather, 35e9);
  const renderer::Effects effects{{core::EffectId::rain_echo, core::EffectId::double_bounce}};
  const renderer::Sampling sampling = renderer::profile_sampling_for(4.0);
  renderer::Sampling estimated = sampling;
  estimated.estimate_error = true;
  const renderer::Frame plain = rendered(world, sampling, effects, {});
  const renderer::Frame dry = rendered(world, sampling, {{core::EffectId::double_bounce}}, {});
  CHECK(plain.bscope_W != dry.bscope_W);
  for (const renderer::Frame& other :
       {rendered(world, sampling, effects), rendered(world, estimated, effects),
        rendered(world, estimated, effects, {})}) {
    CHECK(other.bscope_W == plain.bscope_W);
    CHECK(other.cscope_W_m3 == plain.cscope_W_m3);
  }
  const renderer::LayerSet truth = rendered(world, sampling, effects).layers->bscope;
  const int corner = sensors::range_row(world.sensor.range, std::hypot(kFront_m, kAntennaHeight_m));
  CHECK(truth.double_bounce[at(corner)] > 0.3F);
  CHECK(truth.double_bounce[at(corner - 20)] == 0.0F);
}

TEST_CASE("A C-scope that draws no elevations has no truth by elevation", "[frame_layers]") {
  renderer::World world = plain_with_shed(tests::hivision(kLayerColumns));
  world.sensor.display.cscope_mode = sensors::Display::CScopeMode::flat_earth;
  CHECK_THROWS_AS(rendered(world, renderer::sampling_for(4.0)), core::InputError);
  CHECK_NOTHROW(rendered(world, renderer::sampling_for(4.0), {}, {.layers = true}));
}
