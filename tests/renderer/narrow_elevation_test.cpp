// Elevation beams of a degree and less over flat ground, against the closed form of flat_ground_test.cpp summed over
// the ground that each range cell has. A cell near the boresight spans as much as the whole beam there: samples
// of fixed steps, of 0.115 deg for slices and 0.17 deg for rays, were 4 to 6 dB off in single cells, however many there were.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/city_world.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::flat_ground;
using tests::kGrass;
using tests::kHeight_m;

namespace {

constexpr double kDepression_deg = 10.0;

sensors::Sensor narrow_sensor(double width_deg) {
  sensors::Sensor sensor = tests::hivision(4);
  sensor.antenna.boresight_elevation_rad = core::radians(-kDepression_deg);
  sensor.antenna.elevation.half_power_width_rad = core::radians(width_deg);
  sensor.antenna.elevation.cut_rad = core::radians(1.5625 * width_deg);
  return sensor;
}

// K phi sum of g^2 sigma0 / (R^3 cos psi) dR over the cell, by so many steps that each sees a hundredth of the beam.
double expected_W(const sensors::Sensor& sensor, int cell) {
  constexpr int kSteps = 400;
  const double step_m = sensor.range.cell_m / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double range_m = sensor.range.minimum_m + sensor.range.cell_m * cell + (i + 0.5) * step_m;
    const double sine = kHeight_m / range_m;
    const double gain = sensors::two_way_gain(
        sensor.antenna.elevation, -std::asin(sine) - sensor.antenna.boresight_elevation_rad);
    sum +=
        gain * kGrass.sigma0(sine) / (range_m * range_m * range_m * std::sqrt(1.0 - sine * sine));
  }
  return sensor.radar_constant_W_m2() * sensors::two_way_width(sensor.antenna.azimuth) * sum *
         step_m;
}

struct BeamErrors {
  double largest_dB = 0.0, total_dB = 0.0;
  int cells = 0;
};

// Of cells above a thousandth of the strongest, and of all power.
BeamErrors errors_of(double width_deg, const renderer::Sampling& sampling) {
  const renderer::World world = tests::world(narrow_sensor(width_deg), flat_ground(), {kGrass});
  const sensors::Sensor& sensor = world.sensor;
  const renderer::Frame frame =
      renderer::render_frame(world, sampling, {true, false}, {}, tests::level_pose(kHeight_m));
  std::vector<double> expected(static_cast<std::size_t>(sensor.range.cells));
  for (int cell = 0; cell < sensor.range.cells; ++cell)
    expected[static_cast<std::size_t>(cell)] = expected_W(sensor, cell);
  const double strongest_W = *std::max_element(expected.begin(), expected.end());
  BeamErrors errors;
  double found_W = 0.0, all_W = 0.0;
  for (std::size_t cell = 0; cell < expected.size(); ++cell) {
    const double power_W = frame.bscope_W[cell * static_cast<std::size_t>(sensor.scan.columns) + 1];
    found_W += power_W;
    all_W += expected[cell];
    if (expected[cell] < 1e-3 * strongest_W) continue;
    ++errors.cells;
    errors.largest_dB =
        std::max(errors.largest_dB, std::abs(10.0 * std::log10(power_W / expected[cell])));
  }
  errors.total_dB = 10.0 * std::log10(found_W / all_W);
  return errors;
}

}  // namespace

TEST_CASE("Ground in a narrow elevation beam has its power in every cell, by both casters",
          "[narrow_elevation]") {
  const double width_deg = GENERATE(1.0, 0.5, 0.2, 0.1);
  INFO("beam of " << width_deg << " deg");
  const BeamErrors slices = errors_of(width_deg, tests::slices(4));
  const BeamErrors rays = errors_of(width_deg, renderer::sampling_for(4.0));
  INFO(slices.cells << " cells; slices " << slices.largest_dB << " dB, in all " << slices.total_dB
                    << "; rays " << rays.largest_dB << ", " << rays.total_dB);
  CHECK(slices.cells >= 2);
  // Measured: 0.0052 and 0.022 dB at most, of the widest.
  CHECK(slices.largest_dB < 0.01);
  CHECK(std::abs(slices.total_dB) < 1e-4);
  CHECK(rays.largest_dB < 0.05);
  CHECK(std::abs(rays.total_dB) < 0.005);
}
