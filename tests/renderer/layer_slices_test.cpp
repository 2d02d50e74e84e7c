// Ground truth from slices beside that from rays, and how cells choose what they tell.
#include "renderer/stages/layer_slices.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "renderer/frame.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/bounce_fan.h"
#include "sensors/cells.h"
#include "tests/renderer/city_world.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

const materials::PhongNrcs kLevelGrass(0.0325, 0.136, 1.99);

renderer::LayerSet truth_of(const renderer::World& world, double height_m, bool of_cscope) {
  const renderer::FrameLayers layers =
      *renderer::render_frame(world, renderer::sampling_for(1.0),
                              {.layers = true, .cscope_layers = true}, {},
                              tests::level_pose(height_m))
           .layers;
  return of_cscope ? layers.cscope : layers.bscope;
}

double share(int part, int whole) { return static_cast<double>(part) / whole; }

// What a cell says after these parts, in the left half of its column.
renderer::LayerSet told_of(const std::vector<renderer::LayerEcho>& parts) {
  renderer::LayerCells cells;
  cells.clear(1);
  for (const renderer::LayerEcho& echo : parts) cells.add(0, renderer::azimuths_in(0.0, 0.5), echo);
  renderer::LayerSet set{.visibility = {0.0F},
                         .range_m = {},
                         .grazing_rad = {0.0F},
                         .nrcs = {0.0F},
                         .elevation_rad = {0.0F},
                         .double_bounce = {},
                         .material = {0},
                         .object = {0}};
  cells.write(0, 1, set);
  return set;
}

}  // namespace

// A box around nothing leaves every azimuth to rays: the same city, seen in two ways.
TEST_CASE("Over a city slices and rays tell the same but for their sampling", "[layer_slices]") {
  const sensors::Sensor sensor = tests::narrow(40);
  const renderer::World by_slices = tests::city_world(sensor, tests::everywhere);
  renderer::World by_rays = tests::city_world(sensor, tests::everywhere);
  tests::solids_of(by_rays).others.push_back({{-5e3, -5e3, -10.0}, {5e3, 5e3, 100.0}});
  for (const bool of_cscope : {false, true}) {
    const renderer::LayerSet a = truth_of(by_slices, 120.0, of_cscope);
    const renderer::LayerSet b = truth_of(by_rays, 120.0, of_cscope);
    int lit = 0, lit_once = 0, other_material = 0, other_object = 0, other_grazing = 0,
        other_nrcs = 0, other_range = 0;
    double slices_share = 0.0, rays_share = 0.0;
    for (std::size_t i = 0; i < a.visibility.size(); ++i) {
      slices_share += static_cast<double>(a.visibility[i]);
      rays_share += static_cast<double>(b.visibility[i]);
      if (!(a.visibility[i] > 0.0F) != !(b.visibility[i] > 0.0F)) ++lit_once;
      if (!(a.visibility[i] > 0.0F && b.visibility[i] > 0.0F)) continue;
      ++lit;
      if (a.material[i] != b.material[i]) ++other_material;
      if (a.object[i] != b.object[i]) ++other_object;
      if (std::abs(a.grazing_rad[i] - b.grazing_rad[i]) > 0.1F) ++other_grazing;
      if (std::abs(std::log10(a.nrcs[i] / b.nrcs[i])) > 0.1F) ++other_nrcs;  // 1 dB
      if (of_cscope && std::abs(a.range_m[i] - b.range_m[i]) > 0.01F * b.range_m[i]) ++other_range;
    }
    INFO("C-scope " << of_cscope << ", " << lit << " lit by both, " << lit_once << " by one, "
                    << other_material << " materials, " << other_object << " objects, "
                    << other_grazing << " grazing angles, " << other_nrcs << " NRCS, "
                    << other_range << " ranges differ");
    CHECK(lit > 2000);
    // What rays miss, at most in one of the scopes when this was written: 3.4, 2.4, 1.8, 7.4, 7.2, 4.4 %.
    CHECK(share(lit_once, lit) < 0.06);
    CHECK(share(other_material, lit) < 0.04);
    CHECK(share(other_object, lit) < 0.04);
    CHECK(share(other_grazing, lit) < 0.1);
    CHECK(share(other_nrcs, lit) < 0.1);
    CHECK(share(other_range, lit) < 0.06);
    CHECK(slices_share == Approx(rays_share).epsilon(0.03));
  }
}

TEST_CASE("Columns beside what slices cannot show have the slices' truth", "[layer_slices]") {
  constexpr std::size_t kColumns = 40;
  const sensors::Sensor sensor = tests::narrow(static_cast<int>(kColumns));
  const auto truth_beside = [&](const std::vector<terrain::Box_m>& others) {
    renderer::World world = tests::city_world(sensor, tests::everywhere);
    tests::solids_of(world).others = others;
    return truth_of(world, 120.0, false);
  };
  const renderer::LayerSet slices = truth_beside({}),
                           rays = truth_beside({{{-5e3, -5e3, -10.0}, {5e3, 5e3, 100.0}}}),
                           both = truth_beside({{{20.0, 300.0, 0.0}, {40.0, 320.0, 30.0}}});
  const auto alike = [&](const renderer::LayerSet& other, std::size_t column) {
    for (std::size_t i = column; i < both.visibility.size(); i += kColumns)
      if (both.visibility[i] != other.visibility[i] || both.nrcs[i] != other.nrcs[i] ||
          both.material[i] != other.material[i] || both.object[i] != other.object[i])
        return false;
    return true;
  };
  std::size_t by_slices = 0, by_rays = 0;
  for (std::size_t column = 0; column < kColumns; ++column) {
    by_slices += alike(slices, column) ? 1 : 0;
    by_rays += alike(rays, column) ? 1 : 0;
  }
  CHECK(by_slices + by_rays == kColumns);
  CHECK(by_slices > kColumns / 2);
  CHECK(by_rays > 2);
}

// Elevations beyond the cut send nothing back, whatever stands there.
TEST_CASE("Roofs below the antenna's pattern are not told", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(8);
  std::vector<tests::Body> boxes;
  boxes.push_back(tests::box({-200.0, 205.0, -2.0}, {200.0, 225.0, 4.0}, 0));  // 24 deg down
  boxes.push_back(tests::box({-200.0, 405.0, -2.0}, {200.0, 425.0, 4.0}, 0));  // 13 deg down
  for (std::size_t k = 0; k < 2; ++k)
    boxes[k].mesh.object_of_part = {static_cast<terrain::ObjectId>(k + 1)};
  const renderer::World world =
      tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                   {kLevelGrass}, boxes);
  const renderer::LayerSet truth = truth_of(world, 100.0, false);
  int of_object[3] = {};
  for (std::size_t i = 0; i < truth.visibility.size(); ++i)
    if (truth.visibility[i] > 0.0F) ++of_object[truth.object[i]];
  CHECK(of_object[1] == 0);
  CHECK(of_object[2] > 8);
}

// A piece from straight below to 500 m away: its middle is 22 deg down, its far end 11 deg.
TEST_CASE("Level ground is told as it is whatever the distance of its posts", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(8);
  for (const double spacing_m : {20.0, 1000.0}) {
    const renderer::World world =
        tests::world(sensor, tests::ground(4000.0, spacing_m, [](double, double) { return 0.0; }),
                     {kLevelGrass});
    const renderer::LayerSet truth = truth_of(world, 100.0, false);
    int lit = 0;
    for (int row = 0; row < sensor.range.cells; ++row) {
      const std::size_t i = static_cast<std::size_t>(row) * 8 + 3;
      const double near_m = sensors::range_edge_m(sensor.range, row),
                   far_m = sensors::range_edge_m(sensor.range, row + 1);
      INFO("posts every " << spacing_m << " m, cell " << near_m << " to " << far_m);
      if (near_m < 303.0) {  // 19.4 deg down: the end of the pattern, to within a cell
        if (far_m < 295.0) CHECK(truth.visibility[i] == 0.0F);
        continue;
      }
      ++lit;
      REQUIRE(truth.visibility[i] == 1.0F);
      const double sine = -std::sin(static_cast<double>(truth.elevation_rad[i]));
      CHECK(sine > 100.0 / far_m * 0.9999);
      CHECK(sine < 100.0 / near_m * 1.0001);
      const double grazing = std::sin(static_cast<double>(truth.grazing_rad[i]));
      CHECK(grazing > 100.0 / far_m * 0.9999);
      CHECK(grazing < 100.0 / near_m * 1.0001);
      const double told_dB =
          10.0 * std::log10(static_cast<double>(truth.nrcs[i]) / kLevelGrass.sigma0(grazing));
      CHECK(std::abs(told_dB) < 0.005);
    }
    CHECK(lit > 400);
  }
}

// Pieces of one plane go together: of a plain that bends with the Earth they lie in one almost.
TEST_CASE("Ground that bends with the Earth is told as it bends", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(8);
  constexpr double kRadius_m = 6.371e6;
  const renderer::World world = tests::world(
      sensor,
      tests::ground(
          4000.0, 20.0,
          [](double x_m, double y_m) { return -(x_m * x_m + y_m * y_m) / (2.0 * kRadius_m); }),
      {kLevelGrass});
  const renderer::LayerSet truth = truth_of(world, 100.0, false);
  for (int row = 16; row < sensor.range.cells; ++row) {
    const std::size_t i = static_cast<std::size_t>(row) * 8 + 3;
    const double range_m = sensors::range_middle_m(sensor.range, row);
    INFO(range_m);
    REQUIRE(truth.visibility[i] == 1.0F);
    // Of the sphere that touches below the antenna, 100 m above it.
    const double sine = 100.0 / range_m - range_m / (2.0 * kRadius_m);
    const double half_cell = sensor.range.cell_m / range_m / 2.0;
    const double grazing = std::sin(static_cast<double>(truth.grazing_rad[i]));
    CHECK(grazing == Approx(sine).epsilon(half_cell + 0.003));
    const double told_dB =
        10.0 * std::log10(static_cast<double>(truth.nrcs[i]) / kLevelGrass.sigma0(grazing));
    CHECK(std::abs(told_dB) < 0.01);
  }
}

// The two-way pattern differs by 33 dB from one end of the roof to the other.
TEST_CASE("Far ends of wide roofs weigh what they send", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(8);
  const materials::PhongNrcs tar(0.02, 0.0, 1.0);
  constexpr double kAbove_m = 80.0;
  for (const double over_roof : {0.7, 1.4}) {
    tests::Body hall = tests::box({-200.0, 250.0, -2.0}, {200.0, 400.0, 20.0}, 0);
    hall.mesh.object_of_part = {1};
    renderer::World world = tests::world(
        sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }), {tar}, {hall});
    const int row = sensors::range_row(sensor.range, std::hypot(390.0, kAbove_m));
    const double middle_m = sensors::range_middle_m(sensor.range, row);
    const double sine = kAbove_m / middle_m, cosine = std::sqrt(1.0 - sine * sine);
    const double roof_m2 = tar.sigma0(sine) * renderer::azimuth_width_rad(sensor) * middle_m *
                           sensor.range.cell_m / cosine;
    const double azimuth_rad = sensors::column_middle_rad(sensor.scan, 3);
    world.targets.push_back({.name = "vent",
                             .rcs = materials::ConstantRcs{over_roof * roof_m2},
                             .path = {{0.0,
                                       {middle_m * cosine * std::sin(azimuth_rad),
                                        middle_m * cosine * std::cos(azimuth_rad), 20.5}}}});
    const renderer::LayerSet truth = truth_of(world, 100.0, false);
    const std::size_t i = static_cast<std::size_t>(row) * 8 + 3;
    INFO(over_roof << " of the roof");
    CHECK((truth.material[i] == renderer::kNoMaterial) == (over_roof > 1.0));
  }
}

// A wall 2 deg off the line of sight crosses the column's width within 125 m of range.
TEST_CASE("An oblique wall is seen at its own azimuths in each of its cells", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(8);
  for (const double side : {-1.0, 1.0}) {
    const double turn_rad = side * core::radians(2.0);
    const double azimuth_rad = sensors::column_middle_rad(sensor.scan, 3);
    const glm::dvec2 middle_m(1000.0 * std::sin(azimuth_rad), 1000.0 * std::cos(azimuth_rad));
    const glm::dvec2 along(std::sin(azimuth_rad + turn_rad), std::cos(azimuth_rad + turn_rad));
    const glm::dvec2 across(along.y, -along.x);
    // The wall is the long side that faces the antenna's left or right.
    const glm::dvec2 a = middle_m - along * 200.0, b = middle_m + along * 200.0;
    const glm::dvec2 thick = across * (side > 0.0 ? -30.0 : 30.0);
    tests::Body wall = tests::building({side > 0.0 ? terrain::Ring_m{a, a + thick, b + thick, b}
                                                   : terrain::Ring_m{a, b, b + thick, a + thick},
                                        {},
                                        -2.0,
                                        60.0},
                                       0, 0);
    wall.mesh.object_of_part = {1};
    const renderer::World world =
        tests::world(sensor, tests::ground(4000.0, 50.0, [](double, double) { return 0.0; }),
                     {materials::PhongNrcs(0.5, 0.0, 1.0)}, {wall});
    const renderer::LayerSet truth = truth_of(world, 20.0, false);
    int cells = 0;
    for (int row = 0; row < sensor.range.cells; ++row) {
      const std::size_t i = static_cast<std::size_t>(row) * 8 + 3;
      const double range_m = sensors::range_middle_m(sensor.range, row);
      // Behind its middle the slice's ground is dark: the wall alone is left.
      if (range_m < 1015.0 || range_m > 1050.0 || truth.object[i] != 1) continue;
      ++cells;
      INFO("side " << side << ", " << range_m << " m");
      CHECK(truth.visibility[i] > 0.0F);
      CHECK(truth.visibility[i] < 0.2F);
    }
    CHECK(cells >= 3);
  }
}

TEST_CASE("A building of many materials is one object", "[layer_slices]") {
  const auto part = [](double power_W, terrain::ObjectId object, terrain::MaterialId material) {
    return renderer::LayerEcho{.power_W = power_W, .object = object, .material = material};
  };
  std::vector<renderer::LayerEcho> parts{part(0.35, 4, 1), part(0.30, 4, 2), part(0.35, 0, 3)};
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());
    const renderer::LayerSet set = told_of(parts);
    CHECK(set.object[0] == 4);
    CHECK(set.material[0] != 3);
  }
}

TEST_CASE("A cell tells what sends more than half of its power, in any order", "[layer_slices]") {
  const auto part = [](double power_W, terrain::ObjectId object, float elevation_rad) {
    return renderer::LayerEcho{.power_W = power_W,
                               .range_m = 1000.0,
                               .sin_grazing = 0.1,
                               .nrcs = 0.01,
                               .elevation_rad = elevation_rad,
                               .object = object,
                               .material = 1};
  };
  // Three parts of object 1 beside one of object 2 that is larger than each of them.
  std::vector<renderer::LayerEcho> parts{part(0.2, 1, -0.1F), part(0.25, 1, -0.2F),
                                         part(0.2, 1, -0.3F), part(0.35, 2, 0.1F)};
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());
    const renderer::LayerSet set = told_of(parts);
    CHECK(set.object[0] == 1);
    CHECK(set.elevation_rad[0] < 0.0F);
    CHECK(set.visibility[0] == 0.5F);
    CHECK(set.nrcs[0] == Approx(0.01F));
  }
}

TEST_CASE("Parts of a column's width are counted once, and never as nothing", "[layer_slices]") {
  CHECK(renderer::azimuths_in(0.0, 1.0) == ~renderer::AzimuthMask{0});
  CHECK((renderer::azimuths_in(0.0, 0.3) | renderer::azimuths_in(0.3, 0.7)) ==
        ~renderer::AzimuthMask{0});
  CHECK((renderer::azimuths_in(0.0, 0.3) & renderer::azimuths_in(0.3, 0.7)) == 0U);
  for (const double left : {0.0, 0.4999, 0.999, 1.0})
    CHECK(renderer::azimuths_in(left, 1e-6) != 0U);
}

TEST_CASE("Blocks that are marked pass the azimuth beam to the same bytes", "[layer_slices]") {
  const sensors::Sensor sensor = tests::hivision(41);
  const renderer::World world = tests::city_world(sensor, tests::everywhere);
  renderer::FanSums like;
  renderer::lay_out_fan(world, renderer::sampling_for(4.0), true, like);
  renderer::BounceFan fan;
  for (int frame = 0; frame < 3; ++frame) {  // what one leaves behind must not show in the next
    fan.lay_out(like);
    for (int k = 0; k < 12; ++k) {
      const auto draw = [&](std::uint32_t n, double most) {
        return most * tests::uniform(8, static_cast<std::uint64_t>(100 * frame + k), n);
      };
      renderer::BounceShare share{static_cast<int>(draw(0, like.sub_columns)), {}, 1.0, {}, 2.0};
      share.cells[0] = draw(1, like.cells + 20.0) - 10.0;
      share.cells[1] = share.cells[0] + draw(2, 40.0);
      share.rows[0] = draw(3, like.rows + 20.0) - 10.0;
      share.rows[1] = share.rows[0] + draw(4, 40.0);
      fan.add(share);
    }
    const auto check = [&](const std::vector<double>& sums, int bins,
                           const renderer::FilledBlocks& filled) {
      const int subs = renderer::sampling_for(4.0).sub_columns;
      const std::vector<double> dense =
          renderer::apply_azimuth_beam(sums, bins, fan.sums(), sensor, subs);
      CHECK(renderer::apply_azimuth_beam(sums, bins, fan.sums(), sensor, subs, &filled) == dense);
      CHECK(std::count_if(dense.begin(), dense.end(), [](double W) { return W > 0.0; }) > 100);
      CHECK(std::count(dense.begin(), dense.end(), 0.0) > 100);
    };
    check(fan.sums().range_W_per_rad, like.cells, fan.ranges());
    check(fan.sums().elevation_W_m3_per_rad, like.rows, fan.rows());
  }
}
