// Antenna gain outside the main beam.
#include "renderer/stages/side_lobes.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/units.h"
#include "renderer/plan/plan.h"
#include "renderer/stages/azimuth_beam.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;
using core::radians;

namespace {

sensors::Sensor with_lobes(double level_dB, double extent_deg, int columns = 40) {
  sensors::Sensor sensor = tests::hivision(columns);
  sensor.antenna.azimuth.side_lobe_gain = std::pow(10.0, level_dB / 10.0);
  sensor.antenna.azimuth.side_lobe_extent_rad = radians(extent_deg);
  return sensor;
}

// A fan of one bin over the sensor's columns, 4 sub-columns each.
renderer::FanSums fan_of(const sensors::Sensor& sensor) {
  renderer::FanSums fan;
  fan.step_rad = sensor.scan.column_width_rad() / 4;
  const int margin = static_cast<int>(std::ceil(sensor.antenna.azimuth.cut_rad / fan.step_rad));
  fan.sub_columns = sensor.scan.columns * 4 + 2 * margin;
  fan.first_azimuth_rad = -sensor.scan.field_of_view_rad / 2 - margin * fan.step_rad;
  fan.cells = 1;
  return fan;
}

double grey_of_dB(const sensors::Sensor& sensor, double dB) {
  return dB * 255.0 / (sensor.display.high_dB - sensor.display.low_dB);
}

renderer::World level_grass(const sensors::Sensor& sensor) {
  return tests::world(sensor, tests::ground(4000.0, 250.0, [](double, double) { return 0.0; }),
                      {materials::PhongNrcs(0.0325, 0.136, 1.99)});
}

renderer::Frame frame_of(const sensors::Sensor& sensor) {
  const renderer::World world = level_grass(sensor);
  return renderer::render_frame(world, {}, {true, true}, {}, tests::level_pose(60.0));
}

}  // namespace

TEST_CASE("every azimuth outside the main beam adds the level's square times its power",
          "[side_lobes]") {
  for (const double extent_deg : {4.03, 90.0}) {
    const sensors::Sensor sensor = with_lobes(-30.0, extent_deg);
    const sensors::BeamCut& cut = sensor.antenna.azimuth;
    const renderer::FanSums fan = fan_of(sensor);
    std::vector<double> sums(static_cast<std::size_t>(fan.sub_columns));
    for (std::size_t s = 0; s < sums.size(); ++s)
      sums[s] = 1.0 + 0.5 * std::sin(0.1 * static_cast<double>(s));
    std::vector<double> image(40, 0.0);
    renderer::add_azimuth_side_lobes(sums, 1, fan, sensor, image);
    for (int column = 0; column < 40; ++column) {
      const double centre_rad = (column - 19.5) * sensor.scan.column_width_rad();
      double expected = 0.0;
      for (std::size_t s = 0; s < sums.size(); ++s)
        for (int part = 0; part < 2000; ++part) {
          const double azimuth_rad =
              fan.first_azimuth_rad + (static_cast<double>(s) + (part + 0.5) / 2000) * fan.step_rad;
          const double off_rad = std::abs(azimuth_rad - centre_rad);
          if (off_rad > cut.cut_rad && off_rad <= cut.side_lobe_extent_rad)
            expected += 1e-6 * sums[s] * fan.step_rad / 2000;
        }
      CHECK(image[static_cast<std::size_t>(column)] == Approx(expected).epsilon(2e-4));
    }
  }
}

TEST_CASE("main beam and side lobes together return all of an even fan within 1e-9",
          "[side_lobes]") {
  const sensors::Sensor sensor = with_lobes(-20.0, 180.0);
  const renderer::FanSums fan = fan_of(sensor);
  const std::vector<double> sums(static_cast<std::size_t>(fan.sub_columns), 3.0);
  std::vector<double> image = renderer::apply_azimuth_beam(sums, 1, fan, sensor, 4);
  const double main_rad = sensors::two_way_width(sensor.antenna.azimuth);
  for (const double power : image) CHECK(power == Approx(3.0 * main_rad).epsilon(1e-12));
  renderer::add_azimuth_side_lobes(sums, 1, fan, sensor, image);
  const double fan_rad = fan.sub_columns * fan.step_rad;
  const double lobes_rad = 1e-4 * (fan_rad - 2.0 * sensor.antenna.azimuth.cut_rad);
  for (const double power : image)
    CHECK(power == Approx(3.0 * (main_rad + lobes_rad)).epsilon(1e-9));
}

TEST_CASE("a target shows in every column at twice the level in dB", "[side_lobes]") {
  const sensors::Sensor sensor = with_lobes(-25.0, 90.0);
  renderer::World world = tests::world(sensor, std::nullopt, {});
  const double e = sensor.antenna.boresight_elevation_rad;
  world.targets = {{"sphere",
                    materials::ConstantRcs{1.0},
                    {{0.0, {1.0, 1000.0 * std::cos(e), 100.0 + 1000.0 * std::sin(e)}}},
                    glm::dmat3(1.0)}};
  const renderer::Frame frame =
      renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(100.0));
  const std::size_t row = 119;  // 993.7 to 1000.4 m
  const double peak_W = sensor.radar_constant_W_m2() / 1e12;
  for (const std::size_t column : {0U, 8U, 39U})
    CHECK(10.0 * std::log10(frame.bscope_W[row * 40 + column] / peak_W) ==
          Approx(-50.0).epsilon(0.0).margin(0.01));
}

TEST_CASE("elevation side lobes light the ground that the beam leaves dark", "[side_lobes]") {
  // From 300 m the nearest 900 m lie more than 19.4 deg down, below the beam's cut.
  sensors::Sensor sensor = tests::hivision(4);
  const auto nearest = [](const sensors::Sensor& used) {
    const renderer::World world = level_grass(used);
    return renderer::render_frame(world, {}, {true, false}, {}, tests::level_pose(300.0))
        .bscope_W[30 * 4 + 1];  // 400 m
  };
  CHECK(nearest(sensor) == 0.0);
  sensor.antenna.elevation.side_lobe_gain = 1e-2;
  sensor.antenna.elevation.side_lobe_extent_rad = radians(90.0);
  // Patch power of flat ground, constant over a cell to a percent.
  const double range_m = sensor.range.minimum_m + 30.5 * sensor.range.cell_m;
  const double sine = 300.0 / range_m;
  const double expected_W = sensor.radar_constant_W_m2() * 1e-4 *
                            sensors::two_way_width(sensor.antenna.azimuth) * sensor.range.cell_m *
                            (0.0325 * sine + 0.136 * std::pow(sine, 1.99)) /
                            (std::pow(range_m, 3) * std::sqrt(1.0 - sine * sine));
  CHECK(10.0 * std::log10(nearest(sensor) / expected_W) == Approx(0.0).epsilon(0.0).margin(0.3));
}

TEST_CASE("the plan runs side lobes when they are there and matter", "[side_lobes]") {
  renderer::SceneFacts facts;
  facts.largest_sigma0_over_sine = 0.17;  // grass
  facts.sensor = tests::hivision();
  const renderer::EffectWishes as_needed;
  const auto runs = [&] {
    return renderer::plan(facts, 0.5, as_needed).runs(core::EffectId::side_lobes);
  };
  CHECK_FALSE(renderer::has_side_lobes(facts));
  CHECK_FALSE(runs());
  facts.sensor = with_lobes(-30.0, 90.0, 164);
  CHECK(renderer::has_side_lobes(facts));
  CHECK(runs());
  facts.sensor = with_lobes(-90.0, 90.0, 164);
  CHECK(renderer::has_side_lobes(facts));
  CHECK_FALSE(runs());
  facts.sensor = tests::hivision();
  facts.sensor.antenna.azimuth.shape = sensors::BeamCut::Shape::sinc_squared;
  CHECK(renderer::has_side_lobes(facts));  // 1.25 deg is beyond its null at 0.9 deg
  CHECK(runs());
  const sensors::Sensor cut = renderer::without_side_lobes(facts.sensor);
  CHECK(core::degrees(cut.antenna.azimuth.cut_rad) == Approx(0.903).epsilon(0.0).margin(1e-3));
  facts.sensor = cut;
  CHECK_FALSE(renderer::has_side_lobes(facts));
}

TEST_CASE("a scale that counts in beam widths moves with lobes inside the cut", "[side_lobes]") {
  using Mapping = sensors::Display::Mapping;
  renderer::SceneFacts facts;  // nothing echoes
  facts.sensor = tests::hivision();
  sensors::BeamCut& azimuth = facts.sensor.antenna.azimuth;
  azimuth.shape = sensors::BeamCut::Shape::sinc_squared;
  const double moved_dB = 10.0 * std::log10(sensors::two_way_width(azimuth) /
                                            sensors::two_way_width(sensors::main_beam(azimuth)));
  CHECK(moved_dB > 1e-3);
  const auto bound_dB = [&](Mapping mapping) {
    facts.sensor.display.mapping = mapping;
    return renderer::side_lobe_bound_dB(facts);
  };
  CHECK(bound_dB(Mapping::stc) == moved_dB);
  CHECK(bound_dB(Mapping::seed) == moved_dB);
  facts.sensor.display.low_dB = -140.0;
  facts.sensor.display.high_dB = -80.0;
  CHECK(bound_dB(Mapping::log) == 0.0);
  facts.sensor.seed.active = true;  // a width of its own
  facts.sensor.seed.speed_of_light_mps = 3e8;
  facts.sensor.seed.azimuth_patch_rad = azimuth.half_power_width_rad;
  facts.sensor.seed.maximum_range_m = 3500.0;
  facts.sensor.seed.pulse_s = 1e-7;
  CHECK(bound_dB(Mapping::seed) == 0.0);
}

TEST_CASE("lobes of level zero change no byte, and lobes left out change less than their bound",
          "[side_lobes]") {
  const sensors::Sensor plain = tests::hivision(12);
  const renderer::Frame without = frame_of(plain);
  sensors::Sensor zero = plain;
  zero.antenna.azimuth.side_lobe_extent_rad = radians(90.0);
  CHECK(frame_of(zero).bscope_W == without.bscope_W);
  CHECK(frame_of(renderer::without_side_lobes(zero)).bscope_grey == without.bscope_grey);

  sensors::Sensor faint = with_lobes(-75.0, 90.0, 12);
  faint.antenna.elevation.side_lobe_gain = 1e-8;
  faint.antenna.elevation.side_lobe_extent_rad = radians(60.0);
  renderer::SceneFacts facts;
  facts.largest_sigma0_over_sine = 0.17;  // grass
  facts.sensor = faint;
  const double bound_dB = renderer::side_lobe_bound_dB(facts);
  CHECK(bound_dB > 0.0);
  const double bound_grey = grey_of_dB(faint, bound_dB);
  REQUIRE(bound_grey < 0.25);  // half of half a grey level: pruned
  const renderer::Frame forced = frame_of(faint);
  const renderer::Frame pruned = frame_of(renderer::without_side_lobes(faint));
  CHECK(forced.bscope_W != pruned.bscope_W);
  double worst = 0.0;
  for (std::size_t i = 0; i < forced.bscope_grey.size(); ++i)
    worst = std::max(worst, std::abs(forced.bscope_grey[i] - pruned.bscope_grey[i]));
  // A pattern that reaches further is tabulated in other steps and sampled by other rays.
  CHECK(worst <= bound_grey + 1e-3);
}
