// Hard cases M02 and S05: ground that returns nothing, and targets that no angle points at.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kBlack;
using tests::kGrass;
using tests::kHeight_m;

namespace {

renderer::PointTarget reflector(const glm::dvec3& position_m) {
  renderer::PointTarget target;
  target.rcs = materials::ConstantRcs{100.0};
  target.path = {{0.0, position_m}};
  return target;
}

}  // namespace

TEST_CASE("M02 the dark half of a scene is the noise-only picture, or the floor, exactly",
          "[dark_and_unseen][M02]") {
  constexpr int kColumns = 40;
  // The beam is 1.25 deg wide on either side: five columns of 0.25 deg mix both halves.
  constexpr int kMixed = 6;
  const sensors::Sensor sensor = tests::hivision(kColumns);
  terrain::HeightField field = tests::ground(4000.0, 40.0, [](double x, double y) {
    return 8.0 * std::sin(x / 170.0) * std::cos(y / 230.0);
  });
  for (int row = 0; row + 1 < field.rows; ++row)
    for (int column = 0; column + 1 < field.columns; ++column)
      field.cell_material[field.cell(column, row)] = field.west_m + 40.0 * column >= 0.0 ? 1 : 0;
  const renderer::World half = tests::world(sensor, std::move(field), {kGrass, kBlack});
  const renderer::World nothing = tests::world(sensor, std::nullopt, {kGrass, kBlack});

  for (const renderer::Sampling& sampling :
       {renderer::sampling_for(4.0), renderer::profile_sampling_for(8.0)})
    for (const bool noise : {true, false}) {
      const renderer::Effects effects{core::EffectSet{}.with(core::EffectId::thermal_noise, noise)};
      const renderer::Frame seen =
          renderer::render_frame(half, sampling, {}, effects, tests::level_pose(80.0));
      const renderer::Frame floor =
          renderer::render_frame(nothing, {}, {}, effects, tests::level_pose(80.0));
      double lit_grey = 0.0;
      for (std::size_t i = 0; i < seen.bscope_grey.size(); ++i) {
        const int column = static_cast<int>(i) % kColumns;
        if (column >= kColumns / 2 + kMixed) {
          REQUIRE(seen.bscope_grey[i] == floor.bscope_grey[i]);
          REQUIRE(seen.cscope_grey[i] == floor.cscope_grey[i]);
          if (!noise) REQUIRE(seen.bscope_grey[i] == 0.0);
        } else if (column < kColumns / 2 - kMixed) {
          lit_grey = std::max(lit_grey, seen.bscope_grey[i] - floor.bscope_grey[i]);
        }
      }
      CHECK(lit_grey > 50.0);
    }
}

// Where the pattern ends at full gain, a millionth of it, returned by all above, showed as grey 46.
TEST_CASE("Nothing above an elevation beam with sharp edges returns anything",
          "[dark_and_unseen]") {
  sensors::Sensor sensor = tests::hivision(8);
  sensors::BeamCut& elevation = sensor.antenna.elevation;
  elevation.shape = sensors::BeamCut::Shape::table;
  elevation.cut_rad = core::radians(8.0);
  elevation.table_angle_rad = {-elevation.cut_rad, elevation.cut_rad};
  elevation.table_gain = {1.0, 1.0};
  sensor.antenna.boresight_elevation_rad = core::radians(-20.0);
  // It ends at -12 deg, 289 m away.
  sensor.range.minimum_m = 300.0;
  sensor.range.cells = 60;
  for (const bool cone : {false, true}) {
    sensor.scan.surface = cone ? sensors::ScanSurface::cone : sensors::ScanSurface::plane;
    const renderer::World world =
        tests::world(sensor, tests::ground(1000.0, 50.0, [](double, double) { return 0.0; }),
                     {kGrass}, {tests::box({-20.0, 500.0, -2.0}, {20.0, 520.0, 25.0}, 0)});
    for (const renderer::Sampling& sampling :
         {renderer::sampling_for(4.0), renderer::profile_sampling_for(4.0)}) {
      INFO("cone " << cone << ", slices " << (sampling.caster == renderer::CasterKind::profile));
      const renderer::Frame frame =
          renderer::render_frame(world, sampling, {}, {}, tests::level_pose(kHeight_m));
      CHECK(*std::max_element(frame.bscope_W.begin(), frame.bscope_W.end()) == 0.0);
      CHECK(*std::max_element(frame.cscope_W_m3.begin(), frame.cscope_W_m3.end()) == 0.0);
    }
  }
}

TEST_CASE("S05 targets abeam, behind and at the antenna are not drawn, and are counted",
          "[dark_and_unseen][S05]") {
  sensors::Sensor sensor = tests::hivision();
  sensor.range.minimum_m = 0.0;  // zero distance is inside the gate
  renderer::World world = tests::world(sensor, std::nullopt, {});
  world.targets = {reflector({20.0, 900.0, 0.0})};
  const auto frame_of = [&world] {
    return renderer::render_frame(world, {}, {}, {}, tests::level_pose(kHeight_m));
  };
  const renderer::Frame alone = frame_of();
  CHECK(alone.unprojected == 0);
  CHECK(*std::max_element(alone.bscope_W.begin(), alone.bscope_W.end()) > 0.0);

  const std::vector<glm::dvec3> unseen_m = {
      {500.0, 0.0, kHeight_m},        // on the lateral plane
      {0.0, 0.0, kHeight_m - 400.0},  // and on it straight below
      {0.0, -900.0, kHeight_m},       // behind, where a ratio of coordinates says straight ahead
      {-20.0, -900.0, 120.0},         // the visible one mirrored at the antenna
      {0.0, 0.0, kHeight_m}};         // at the antenna
  for (const glm::dvec3& position_m : unseen_m) world.targets.push_back(reflector(position_m));
  const renderer::Frame all = frame_of();
  CHECK(all.unprojected == unseen_m.size());
  CHECK(all.bscope_W == alone.bscope_W);
  CHECK(all.cscope_W_m3 == alone.cscope_W_m3);
  CHECK(all.bscope_grey == alone.bscope_grey);
  CHECK(all.cscope_grey == alone.cscope_grey);
}
