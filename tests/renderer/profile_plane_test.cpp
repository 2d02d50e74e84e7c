// The profile caster on planes, where the radar equation has a closed form in every range cell.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

// Ranges to 1.2 km: farther cells prove nothing new, and fewer posts are quicker.
sensors::Sensor short_sensor(sensors::Sensor sensor) {
  sensor.range.cells = 150;
  return sensor;
}

// The whole plane z = slope . (x, y) - kHeight_m as seen by a sensor at the origin's height.
std::vector<tests::VisiblePiece> plane_under(const sensors::Sensor& sensor, const glm::dvec2& slope,
                                             double azimuth_rad,
                                             const materials::PhongNrcs& nrcs = tests::kGamma) {
  const double far_m = sensor.range.maximum_m();
  const double rise = slope.x * std::sin(azimuth_rad) + slope.y * std::cos(azimuth_rad);
  return {{{0.0, -kHeight_m},
           {far_m, rise * far_m - kHeight_m},
           nrcs,
           kHeight_m / std::sqrt(1.0 + glm::dot(slope, slope))}};
}

renderer::World plane(const sensors::Sensor& sensor, double spacing_m, const glm::dvec2& slope,
                      const materials::PhongNrcs& nrcs = tests::kGamma) {
  const double half_m = std::max(1250.0, spacing_m / 2);
  return tests::world(sensor,
                      tests::ground(half_m, spacing_m,
                                    [&](double x, double y) { return slope.x * x + slope.y * y; }),
                      {nrcs});
}

// Largest relative error over all sub-columns, seen from kHeight_m above `place_m`.
double plane_error(const renderer::World& world, const glm::dvec2& slope, const glm::dvec2& place_m,
                   double heading_rad = 0.0, const materials::PhongNrcs& nrcs = tests::kGamma) {
  const glm::dvec3 position_m(place_m, glm::dot(slope, place_m) + kHeight_m);
  const renderer::FanSums sums =
      tests::cast_profile(world, 1, tests::level_antenna(position_m, heading_rad));
  double largest = 0.0;
  for (int sub = 0; sub < sums.sub_columns; ++sub) {
    const double azimuth_rad = heading_rad + tests::slice_azimuth_rad(sums, sub);
    const std::vector<double> expected =
        tests::closed_form(world.sensor, plane_under(world.sensor, slope, azimuth_rad, nrcs));
    largest = std::max(largest, tests::largest_error(sums, sub, expected));
  }
  return largest;
}

// Power times R^3 of level ground in one row of the C-scope, from the highest one on:
//   K integral g^2(e) sigma0(psi) / sin(psi) R de ,  psi = e_horizon - e ,  R = h / sin(psi) ;
// nothing where the row is not wholly inside the gate, or next to straight below, where a sub-column takes
// parts of many slices. `pitch_rad`: the antenna's, upwards.
std::optional<double> row_of_level_ground(const sensors::Sensor& sensor, int row, double pitch_rad,
                                          const materials::PhongNrcs& nrcs) {
  constexpr int kSteps = 200;
  const double row_rad = sensor.display.cscope_span_rad / sensor.display.cscope_rows;
  const double top_rad = sensor.display.cscope_top_rad - row_rad * row;
  const double highest_rad = -(top_rad + pitch_rad), lowest_rad = highest_rad + row_rad;
  if (std::abs(highest_rad - core::kPi / 2) < core::radians(4.0)) return std::nullopt;
  if (highest_rad <= 0.0 || kHeight_m / std::sin(highest_rad) >= sensor.range.maximum_m() ||
      kHeight_m / std::sin(lowest_rad) <= sensor.range.minimum_m)
    return std::nullopt;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double below_rad = row_rad * (k + 0.5) / kSteps, sine = std::sin(highest_rad + below_rad);
    const double gain = sensors::two_way_gain(
        sensor.antenna.elevation, top_rad - below_rad - sensor.antenna.boresight_elevation_rad);
    sum += gain * nrcs.sigma0(sine) / sine * kHeight_m / sine;
  }
  return sensor.radar_constant_W_m2() * sum * row_rad / kSteps;
}

}  // namespace

TEST_CASE("The quadrature of the expected power is the elementary integral", "[profile]") {
  // Level ground of constant gamma: with t = atan(h / s) the integral of h ds / (h^2 + s^2)^2 is
  // -(2 t - sin 2 t) / 4 h^2.
  const sensors::Sensor sensor = tests::even_hivision(1);
  const std::vector<double> found = tests::closed_form(sensor, plane_under(sensor, {}, 0.0));
  const auto elementary = [](long double range_m) {
    const long double h = kHeight_m, t = std::asin(h / range_m);
    return -(2 * t - std::sin(2 * t)) / (4 * h * h);
  };
  // The last cell is cut at the last cell's horizontal distance, not at its range.
  for (int k = 0; k + 1 < sensor.range.cells; ++k) {
    const long double near_m = sensor.range.minimum_m + sensor.range.cell_m * k;
    const auto expected = static_cast<double>(
        elementary(near_m + static_cast<long double>(sensor.range.cell_m)) - elementary(near_m));
    REQUIRE(found[static_cast<std::size_t>(k)] / (sensor.radar_constant_W_m2() * 0.02) ==
            Approx(expected).epsilon(1e-10));
  }
}

TEST_CASE("Every range cell of a level plane holds its exact integral, whatever the posts",
          "[profile]") {
  const sensors::Sensor sensor = short_sensor(tests::even_hivision(4));
  for (const double spacing_m : {10.0, 250.0, 8000.0}) {  // the last: one cell under all of it
    const renderer::World world = plane(sensor, spacing_m, {});
    CHECK(plane_error(world, {}, {0.0, 0.0}) < 1e-9);
    CHECK(plane_error(world, {}, {3.7, -1.3}) < 1e-9);
  }
}

TEST_CASE("Slices along grid lines and diagonals lose no ground", "[profile]") {
  // One column: the fan has a slice exactly ahead. The sensor stands on a post, on a line, on a
  // diagonal.
  for (const glm::dvec2 slope : {glm::dvec2(0.0, 0.0), {0.01, -0.02}}) {
    const renderer::World world = plane(short_sensor(tests::even_hivision(1)), 10.0, slope);
    for (int eighth = 0; eighth < 8; ++eighth)
      for (const glm::dvec2 place_m : {glm::dvec2(0.0, 0.0), {0.0, 4.0}, {7.0, 0.0}, {4.0, 4.0}}) {
        INFO(45 * eighth << " deg from " << place_m.x << ", " << place_m.y);
        CHECK(plane_error(world, slope, place_m, core::kPi / 4 * eighth) < 1e-9);
      }
  }
}

TEST_CASE("Planes inclined along track and across hold the exact integral", "[profile]") {
  const sensors::Sensor sensor = short_sensor(tests::even_hivision(4));
  for (const glm::dvec2 slope : {glm::dvec2(0.0, 0.05), {0.0, -0.01}, {0.3, 0.0}, {-0.2, 0.1}})
    for (const double spacing_m : {10.0, 250.0}) {
      const renderer::World world = plane(sensor, spacing_m, slope);
      for (const double heading_rad : {0.0, 0.6}) {
        INFO("slope " << slope.x << ", " << slope.y << ", heading " << heading_rad);
        CHECK(plane_error(world, slope, {3.7, -1.3}, heading_rad) < 1e-9);
      }
    }
}

// The boresight itself has no heading there.
TEST_CASE("Slices of a beam that is centred straight down lie in its azimuths", "[profile]") {
  sensors::Sensor sensor = short_sensor(tests::even_hivision(4));
  sensor.antenna.boresight_elevation_rad = -core::kPi / 2;
  for (const glm::dvec2 slope : {glm::dvec2(0.03, 0.0), {0.0, -0.05}})
    for (const double heading_rad : {0.0, 0.6}) {
      INFO("slope " << slope.x << ", " << slope.y << ", heading " << heading_rad);
      CHECK(plane_error(plane(sensor, 10.0, slope), slope, {3.7, -1.3}, heading_rad) < 1e-9);
    }
}

TEST_CASE("The local grazing angle counts from the facet, not from its cut", "[profile]") {
  // sigma0 / sin(psi) = 0.1 sin(psi) changes by cell / R = 3 % over the first cell, and a piece
  // takes the value of its middle for all of it, also for the part beyond a border between cells. A
  // cross slope of 0.3 taken for level would be off by 4 % in every cell.
  const materials::PhongNrcs square(0.0, 0.1, 2.0);
  for (const glm::dvec2 slope : {glm::dvec2(0.0, 0.0), {0.3, 0.0}, {-0.2, 0.1}})
    for (const double spacing_m : {10.0, 250.0}) {
      const renderer::World world =
          plane(short_sensor(tests::even_hivision(4)), spacing_m, slope, square);
      CHECK(plane_error(world, slope, {3.7, -1.3}, 0.0, square) < 5e-3);
    }
}

TEST_CASE("A frame over level ground is the cell's integral times the azimuth beam's",
          "[profile]") {
  const sensors::Sensor sensor = short_sensor(tests::even_hivision(6));
  const renderer::World world = plane(sensor, 10.0, {});
  const std::vector<double> per_rad = tests::closed_form(sensor, plane_under(sensor, {}, 0.0));
  const double beam_rad = sensors::two_way_width(sensor.antenna.azimuth);
  for (const double slices : {1.0, 16.0}) {
    const renderer::Frame frame =
        renderer::render_frame(world, renderer::profile_sampling_for(slices), {true, false}, {},
                               tests::level_pose(kHeight_m));
    for (std::size_t i = 0; i < frame.bscope_W.size(); ++i)
      REQUIRE(frame.bscope_W[i] == Approx(per_rad[i / 6] * beam_rad).epsilon(1e-9));
  }
}

TEST_CASE("HiVision over Phong ground follows the closed form within 0.01 dB at 4 slices",
          "[profile]") {
  const sensors::Sensor sensor = short_sensor(tests::hivision(12));
  const double beam_rad = sensors::two_way_width(sensor.antenna.azimuth);
  for (const materials::PhongNrcs& nrcs : {materials::PhongNrcs(0.0325, 0.136, 1.99),
                                           materials::PhongNrcs(0.0, 0.01, 0.0), tests::kGamma})
    for (const double spacing_m : {10.0, 250.0}) {
      const std::vector<double> per_rad =
          tests::closed_form(sensor, plane_under(sensor, {}, 0.0, nrcs));
      const renderer::World world = plane(sensor, spacing_m, {}, nrcs);
      const renderer::Frame frame =
          renderer::render_frame(world, renderer::profile_sampling_for(4.0), {true, false}, {},
                                 tests::level_pose(kHeight_m));
      double largest_dB = 0.0;
      std::size_t worst_cell = 0;
      for (std::size_t i = 0; i < frame.bscope_W.size(); ++i) {
        const double error_dB =
            std::abs(10.0 * std::log10(frame.bscope_W[i] / (per_rad[i / 12] * beam_rad)));
        if (error_dB <= largest_dB) continue;
        largest_dB = error_dB;
        worst_cell = i / 12;
      }
      INFO("posts " << spacing_m << " m apart, worst cell " << worst_cell);
      CHECK(largest_dB < 0.01);
    }
}

// Close by a range cell takes up to six rows. Spread evenly over them its power was 0.1 dB off in the
// outer ones, at any number of slices. Behind straight below its far end is the lower one.
TEST_CASE("Rows of the C-scope over level ground follow the closed form, however many a cell takes",
          "[profile]") {
  struct Case {
    sensors::ScanSurface surface;
    double pitch_deg, minimum_m;
  };
  using sensors::ScanSurface;
  for (const materials::PhongNrcs& nrcs :
       {materials::PhongNrcs(0.0325, 0.136, 1.99), tests::kGamma})
    for (const Case& of : {Case{ScanSurface::plane, 0.0, 200.0},
                           {ScanSurface::plane, -4.0, 200.0},
                           {ScanSurface::plane, -90.0, 50.0},
                           {ScanSurface::cone, 0.0, 200.0},
                           {ScanSurface::cone, -4.0, 200.0},
                           {ScanSurface::cone, -90.0, 50.0}}) {
      sensors::Sensor sensor = short_sensor(tests::hivision(1));
      sensor.scan.surface = of.surface;
      sensor.range.minimum_m = of.minimum_m;
      const double pitch_rad = core::radians(of.pitch_deg);
      const sensors::AntennaFrame antenna{{0.0, 0.0, kHeight_m},
                                          {0.0, std::cos(pitch_rad), std::sin(pitch_rad)},
                                          {1.0, 0.0, 0.0},
                                          {0.0, -std::sin(pitch_rad), std::cos(pitch_rad)}};
      const renderer::FanSums sums =
          tests::cast_profile(plane(sensor, 10.0, {}, nrcs), 1, antenna, true);
      const auto middle =
          static_cast<std::size_t>(std::floor(-sums.first_azimuth_rad / sums.step_rad));
      double largest_dB = 0.0;
      int known = 0;
      for (int row = 0; row < sums.rows; ++row) {
        const auto expected = row_of_level_ground(sensor, row, pitch_rad, nrcs);
        if (!expected) continue;
        const double found =
            sums.elevation_W_m3_per_rad[middle * static_cast<std::size_t>(sums.rows) +
                                        static_cast<std::size_t>(row)];
        largest_dB = std::max(largest_dB, std::abs(10.0 * std::log10(found / *expected)));
        ++known;
      }
      INFO("pitch " << of.pitch_deg << " deg, cone " << (of.surface == ScanSurface::cone));
      CHECK(known > 100);
      // The density bends within a piece of up to 0.002 rad: 0.012 dB as measured, 0.1 if spread evenly. In
      // single rows 5 to 15 deg from straight below 0.026, and 0.2 if the far end were always the higher one.
      CHECK(largest_dB < (of.pitch_deg < -45.0 ? 0.03 : 0.015));
    }
}
