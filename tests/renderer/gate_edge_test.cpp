// The rows of the C-scope that hold the borders of the range gate, on flat ground. At elevation -e
// the ground lies at R = h / sin e, so a row from e1 to e2 gets, from what lies inside the gate,
//   sum P R^3 = K phi_eff * integral of g_el(e)^2 sigma0(e) / sin(e) * h / sin(e) de
// with phi_eff the integral of the squared azimuth pattern. A caster that counts a ray's interval
// whole or not at all gives that row up to its whole power too much or too little.
#include <catch2/catch.hpp>

#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;

namespace {

// `gated`: what lies inside the range gate only.
double row_W_m3(const sensors::Sensor& sensor, double height_m, int row, bool gated) {
  const sensors::Display& display = sensor.display;
  const double row_rad = display.cscope_span_rad / display.cscope_rows;
  double low_rad = -(display.cscope_top_rad - row * row_rad);
  double high_rad = -(display.cscope_top_rad - (row + 1) * row_rad);
  if (gated) {
    low_rad = std::max(low_rad, std::asin(height_m / sensor.range.maximum_m()));
    high_rad = std::min(high_rad, std::asin(height_m / sensor.range.minimum_m));
  }
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double depression_rad = low_rad + (high_rad - low_rad) * (i + 0.5) / kSteps;
    const double sine = std::sin(depression_rad);
    const double gain = sensors::two_way_gain(
        sensor.antenna.elevation, -depression_rad - sensor.antenna.boresight_elevation_rad);
    sum += gain * kGrass.sigma0(sine) * height_m / (sine * sine);
  }
  return sensor.radar_constant_W_m2() * sensors::two_way_width(sensor.antenna.azimuth) * sum *
         (high_rad - low_rad) / kSteps;
}

// `tolerance`: as a share of the row's power were it lit from edge to edge.
void check_gate_rows(const renderer::Sampling& sampling, double tolerance) {
  const sensors::Sensor sensor = tests::hivision(4);
  const renderer::World world = tests::world(
      sensor, tests::ground(4000.0, 250.0, [](double, double) { return 0.0; }), {kGrass});
  const sensors::Display& display = sensor.display;
  const double rows_per_rad = display.cscope_rows / display.cscope_span_rad;
  // The near edge falls at other shares of its row each time.
  for (const double height_m : {15.0, 17.3, 18.9, 21.1, 24.7, 28.2}) {
    const renderer::Frame frame =
        renderer::render_frame(world, sampling, {}, {}, tests::level_pose(height_m));
    for (const double edge_m : {sensor.range.minimum_m, sensor.range.maximum_m()}) {
      const int row =
          static_cast<int>((display.cscope_top_rad + std::asin(height_m / edge_m)) * rows_per_rad);
      const double expected_W_m3 = row_W_m3(sensor, height_m, row, true);
      const double whole_W_m3 = row_W_m3(sensor, height_m, row, false);
      const double got_W_m3 =
          frame.cscope_W_m3[static_cast<std::size_t>(row * sensor.scan.columns + 1)];
      INFO("height " << height_m << " m, edge " << edge_m << " m, row " << row);
      REQUIRE(expected_W_m3 < whole_W_m3);
      CHECK((got_W_m3 - expected_W_m3) / whole_W_m3 == Approx(0.0).epsilon(0.0).margin(tolerance));
    }
  }
}

}  // namespace

// Neighbouring rays meet half way between their ranges, 6.67^2 / (4 * 200) = 0.056 m behind the
// true place: 0.07 of a row of level ground where that is most, at a height of 17.3 m. What a ray
// stands for is spread evenly over its ranges: where the gate cuts near its end that is up to 5 %
// off.
TEST_CASE("A row of the C-scope with the gate's edge in it gets what lies inside: rays", "[flat]") {
  check_gate_rows(renderer::sampling_for(4.0), 0.12);
}

// Slices cut at the gate itself, and spread a piece's power evenly over the rows it crosses.
TEST_CASE("A row of the C-scope with the gate's edge in it gets what lies inside: slices",
          "[flat][profile]") {
  check_gate_rows(renderer::profile_sampling_for(4.0), 0.02);
}
