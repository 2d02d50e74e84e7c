// The rows of the C-scope around the border of two grounds, where a range cell covers several rows. At
// elevation -e flat ground lies at R = h / sin e, so a row from e1 to e2 gets
//   sum P R^3 = K phi_eff * integral of g_el(e)^2 sigma0(e) / sin(e) * h / sin(e) de
// with the sigma0 of what lies there. Rays a range cell apart know the border to a cell, and the mean of
// many spreads the brighter ground over the rows of one.
#include <catch2/catch.hpp>

#include "sensors/antenna/beam_pattern.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

const materials::PhongNrcs kBrightGround(0.0325, 0.136, 1.99);
const materials::PhongNrcs kDarkGround(0.002, 0.01, 2.5);

struct Border {
  sensors::Sensor sensor = tests::hivision(4);
  double height_m = 0.0, north_m = 0.0;  // dark nearer than that, bright behind

  double border_rad() const { return std::atan2(height_m, north_m); }
  double row_rad() const { return sensor.display.cscope_span_rad / sensor.display.cscope_rows; }
  // Depression of a row's upper edge.
  double upper_rad(int row) const { return row * row_rad() - sensor.display.cscope_top_rad; }
  int border_row() const {
    return static_cast<int>((sensor.display.cscope_top_rad + border_rad()) / row_rad());
  }

  template <class Sigma0>
  double row_W_m3(int row, const Sigma0& sigma0_of) const {
    constexpr int kSteps = 2000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double depression_rad = upper_rad(row) + row_rad() * (i + 0.5) / kSteps;
      const double sine = std::sin(depression_rad);
      const double gain = sensors::two_way_gain(
          sensor.antenna.elevation, -depression_rad - sensor.antenna.boresight_elevation_rad);
      sum += gain * sigma0_of(depression_rad, sine) * height_m / (sine * sine);
    }
    return sensor.radar_constant_W_m2() * sensors::two_way_width(sensor.antenna.azimuth) * sum *
           row_rad() / kSteps;
  }
};

// Largest error of the rows around the border, as a share of what the brighter ground gives a row.
double largest_error(const renderer::Sampling& sampling) {
  double largest = 0.0;
  for (const double height_m : {16.0, 21.3, 25.9, 31.1}) {
    Border border;
    border.height_m = height_m;
    border.north_m = 280.0;
    const renderer::World world = tests::world(
        border.sensor, tests::ground(4000.0, 250.0, [](double, double) { return 0.0; }),
        {kBrightGround, kDarkGround}, {},
        {terrain::rectangle_patch({0.0, 140.0}, {0.0, 1.0}, 280.0, 400.0, 1)});
    const renderer::Frame frame =
        renderer::render_frame(world, sampling, {}, {}, tests::level_pose(height_m));
    for (int row = border.border_row() - 6; row <= border.border_row() + 6; ++row) {
      const double expected_W_m3 = border.row_W_m3(row, [&](double depression_rad, double sine) {
        return depression_rad > border.border_rad() ? kDarkGround.sigma0(sine)
                                                    : kBrightGround.sigma0(sine);
      });
      const double bright_W_m3 =
          border.row_W_m3(row, [](double, double sine) { return kBrightGround.sigma0(sine); });
      const double got_W_m3 =
          frame.cscope_W_m3[static_cast<std::size_t>(row * border.sensor.scan.columns + 1)];
      largest = std::max(largest, std::abs(got_W_m3 - expected_W_m3) / bright_W_m3);
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("Rays know where one ground ends and another begins to a part of a C-scope row",
          "[rays]") {
  for (const double rays_per_cell : {2.0, 4.0, 16.0}) {
    INFO(rays_per_cell << " rays per cell and column");
    CHECK(largest_error(renderer::sampling_for(rays_per_cell)) < 0.2);
  }
  CHECK(largest_error(renderer::profile_sampling_for(8.0)) < 0.02);
}
