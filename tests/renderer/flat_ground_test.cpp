// The ray caster against the closed form of flat ground:
//   P(cell) = Pt G0^2 lambda^2 / (4 pi)^3 * phi_eff * integral over the cell of g_el(e)^2 sigma0(psi) / (R^3 cos psi) dR
// with sin psi = h / R on a plane, e = -psi, and phi_eff the integral of the squared azimuth
// pattern (0.60215 deg).
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "core/constants.h"
#include "core/units.h"
#include "renderer/accuracy/naive_caster.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/ray_caster.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::flat_ground;
using tests::kGrass;
using tests::kHeight_m;

namespace {

// Simpson over the cell, 20 intervals: the integrand is smooth on the scale of a cell.
double closed_form_W(const sensors::Sensor& sensor, const materials::PhongNrcs& nrcs, int cell,
                     const std::function<double(double)>& sin_grazing,
                     const std::function<double(double)>& depression_rad) {
  const auto integrand = [&](double range_m) {
    const double sine = sin_grazing(range_m);
    const double gain =
        sensors::two_way_gain(sensor.antenna.elevation,
                              -depression_rad(range_m) - sensor.antenna.boresight_elevation_rad);
    return gain * nrcs.sigma0(sine) / (range_m * range_m * range_m * std::sqrt(1.0 - sine * sine));
  };
  const double from_m = sensor.range.minimum_m + sensor.range.cell_m * cell;
  const double step_m = sensor.range.cell_m / 20.0;
  double sum = 0.0;
  for (int i = 0; i <= 20; ++i)
    sum += (i == 0 || i == 20 ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * integrand(from_m + step_m * i);
  return sensor.radar_constant_W_m2() * sensors::two_way_width(sensor.antenna.azimuth) * sum *
         step_m / 3.0;
}

double plane_sine(double range_m) { return kHeight_m / range_m; }
double plane_depression(double range_m) { return std::asin(kHeight_m / range_m); }

struct Error {
  double largest_dB = 0.0, mean_dB = 0.0;
  int empty = 0, worst_cell = -1;
};

// Over all cells of the middle columns: the margin of rays covers the beam there.
Error compare(const renderer::World& world, const renderer::Sampling& sampling,
              const materials::PhongNrcs& nrcs,
              const std::function<double(double)>& sin_grazing = plane_sine,
              const std::function<double(double)>& depression = plane_depression) {
  const sensors::Sensor& sensor = world.sensor;
  const renderer::Frame frame =
      renderer::render_frame(world, sampling, {true, false}, {}, tests::level_pose(kHeight_m));
  Error error;
  int count = 0;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double expected_W = closed_form_W(sensor, nrcs, cell, sin_grazing, depression);
    for (int column = 0; column < sensor.scan.columns; ++column) {
      const double power_W =
          frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + column)];
      if (!(power_W > 0.0)) {
        ++error.empty;
        continue;
      }
      const double difference_dB = 10.0 * std::log10(power_W / expected_W);
      if (std::abs(difference_dB) > error.largest_dB) {
        error.largest_dB = std::abs(difference_dB);
        error.worst_cell = cell;
      }
      error.mean_dB += difference_dB;
      ++count;
    }
  }
  error.mean_dB /= std::max(count, 1);
  return error;
}

renderer::Sampling one_ray_per_cell() {
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  sampling.rays_per_cell = 1.0;
  return sampling;
}

const materials::PhongNrcs kConstant(0.0, 0.01, 0.0);
const materials::PhongNrcs kConstantGamma(0.02, 0.0, 1.0);

}  // namespace

TEST_CASE("The sensor's azimuth beam integrates to 0.60215 deg", "[flat]") {
  CHECK(core::degrees(sensors::two_way_width(tests::hivision().antenna.azimuth)) ==
        Approx(0.60215).epsilon(1e-4));
}

// It was 1.2 dB darker: stc took the table's patch, which no cell of the picture has.
TEST_CASE("stc shows the NRCS of flat ground with the published table's sensor too", "[flat]") {
  core::ProblemList problems;
  sensors::Sensor sensor = sensors::read_sensor(
      std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision-seed.toml", problems);
  sensor.scan.field_of_view_rad *= 4.0 / sensor.scan.columns;
  sensor.scan.columns = 4;
  sensor.display.mapping = sensors::Display::Mapping::stc;
  sensor.display.low_dB = -55.0;
  sensor.display.high_dB = 5.0;
  const renderer::World world = tests::world(sensor, flat_ground(), {kConstant});  // -20 dB
  const renderer::Frame frame = renderer::render_frame(
      world, renderer::sampling_for(64.0), {true, false}, {}, tests::level_pose(kHeight_m));
  // Where the boresight meets the ground the beam takes nothing.
  const int row = sensors::range_row(sensor.range,
                                     kHeight_m / std::sin(-sensor.antenna.boresight_elevation_rad));
  for (std::size_t column = 0; column < 4; ++column)
    CHECK(-55.0 + frame.bscope_grey[static_cast<std::size_t>(row) * 4 + column] * 60.0 / 255.0 ==
          Approx(-20.0).epsilon(0.0).margin(0.1));
}

TEST_CASE(
    "R08 flat ground at one ray per cell follows the closed form within 0.5 dB, no cell empty",
    "[flat]") {
  for (const materials::PhongNrcs& nrcs : {kGrass, kConstant, kConstantGamma}) {
    const renderer::World world = tests::world(tests::hivision(12), flat_ground(), {nrcs});
    const Error error = compare(world, one_ray_per_cell(), nrcs);
    CHECK(error.empty == 0);
    CHECK(error.largest_dB < 0.5);
    CHECK(std::abs(error.mean_dB) < 0.02);
  }
}

TEST_CASE("R08 flat ground at reference quality follows the closed form within 0.05 dB", "[flat]") {
  for (const materials::PhongNrcs& nrcs : {kGrass, kConstant}) {
    const renderer::World world = tests::world(tests::hivision(4), flat_ground(), {nrcs});
    const Error error = compare(world, renderer::reference_sampling(1), nrcs);
    INFO("worst cell " << error.worst_cell);
    CHECK(error.empty == 0);
    CHECK(error.largest_dB < 0.05);
    CHECK(std::abs(error.mean_dB) < 0.02);
  }
}

TEST_CASE("R08 cells of 3 m keep their rays out to 3.7 km: 0.5 dB preview, 0.1 dB reference",
          "[flat]") {
  sensors::Sensor sensor = tests::hivision(2);
  sensor.range.cell_m = 3.0;
  sensor.range.cells = 1166;
  const renderer::World world = tests::world(sensor, flat_ground(), {kConstant});
  const Error preview = compare(world, one_ray_per_cell(), kConstant);
  CHECK(preview.empty == 0);
  CHECK(preview.largest_dB < 0.5);
  CHECK(std::abs(preview.mean_dB) < 0.02);
  const Error reference = compare(world, renderer::reference_sampling(1, 4), kConstant);
  CHECK(reference.empty == 0);
  CHECK(reference.largest_dB < 0.1);
  CHECK(std::abs(reference.mean_dB) < 0.02);

  // 1000 rays spread evenly over 10 degrees leave most far cells empty.
  const double span_rad = core::radians(10.0);
  renderer::FanSums fan;
  renderer::lay_out_fan(world, renderer::naive_sampling(renderer::NaiveKind::plain), false, fan);
  const double top_rad = -std::asin(kHeight_m / sensor.range.maximum_m());
  renderer::FanSums even;
  renderer::NaiveCaster(world, renderer::NaiveKind::plain, 1000.0 * fan.sub_columns,
                        {top_rad - span_rad, top_rad})
      .cast({{0.0, 0.0, kHeight_m}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}, false,
            even);
  const auto empty =
      std::count(even.range_W_per_rad.begin(), even.range_W_per_rad.begin() + even.cells, 0.0);
  CHECK(empty > even.cells / 2);
}

// They counted cos(e) once more, a quarter of a dB at 20 deg, which no number of rays took away.
TEST_CASE("Naive rays converge to the closed form as the others do", "[flat]") {
  const sensors::Sensor sensor = tests::hivision(4);
  const renderer::World world = tests::world(sensor, flat_ground(), {kConstant});
  renderer::FanSums sums;
  renderer::lay_out_fan(world, renderer::naive_sampling(renderer::NaiveKind::dithered), false,
                        sums);
  renderer::NaiveCaster(world, renderer::NaiveKind::dithered, 3e4 * sums.sub_columns,
                        {core::radians(-19.0), core::radians(-1.0)})
      .cast(tests::antenna_at(kHeight_m), false, sums);
  const double phi_rad = sensors::two_way_width(sensor.antenna.azimuth);
  const int first = sensors::range_row(sensor.range, 230.0),
            last = sensors::range_row(sensor.range, 340.0);  // 10 to 15 deg below the horizon
  double found_W = 0.0, expected_W = 0.0;
  for (int cell = first; cell <= last; ++cell) {
    expected_W += closed_form_W(sensor, kConstant, cell, plane_sine, plane_depression) / phi_rad;
    for (int column = 0; column < sums.sub_columns; ++column)
      found_W += sums.range_W_per_rad[static_cast<std::size_t>(column * sums.cells + cell)] /
                 sums.sub_columns;
  }
  CHECK(10.0 * std::log10(found_W / expected_W) == Approx(0.0).margin(0.01).epsilon(0.0));
}

// Azimuths beyond 90 deg of a cone are no directions. What lay there was taken from the picture: a frame of innsbruck-26
// ended with less power than none.
TEST_CASE("A cone of 180 deg takes no power away", "[flat]") {
  sensors::Sensor sensor = tests::hivision(180);
  sensor.scan.surface = sensors::ScanSurface::cone;
  sensor.scan.field_of_view_rad = core::kPi;
  const renderer::World world = tests::world(sensor, flat_ground(), {kConstant});
  renderer::FanSums sums;
  const renderer::Sampling sampling = renderer::sampling_for(4.0);
  renderer::lay_out_fan(world, sampling, false, sums);
  renderer::RayCaster(world, sampling).cast(tests::antenna_at(kHeight_m), false, sums);
  const auto begin = sums.range_W_per_rad.begin();
  CHECK(*std::min_element(begin, sums.range_W_per_rad.end()) >= 0.0);
  const auto sum_of = [&](int column) {
    return std::accumulate(begin + column * sums.cells, begin + (column + 1) * sums.cells, 0.0);
  };
  REQUIRE(sums.first_azimuth_rad < -core::kPi / 2 - 2.0 * sums.step_rad);
  CHECK(sum_of(0) == 0.0);
  CHECK(sum_of(sums.sub_columns - 1) == 0.0);
  CHECK(sum_of(sums.sub_columns / 2) > 0.0);
}

TEST_CASE("Curved ground follows psi = h/R - R/2Re", "[flat]") {
  constexpr double kRadius_m = 6371000.0;
  const auto sagitta = [](double x, double y) { return -(x * x + y * y) / (2.0 * kRadius_m); };
  const renderer::World world =
      tests::world(tests::hivision(4), tests::ground(4000.0, 20.0, sagitta), {kGrass});
  // Exact on the sphere; to first order grazing is h/R - R/2Re and depression h/R + R/2Re. The
  // triangles of 20 m follow the sphere to 8 um.
  const Error error = compare(
      world, one_ray_per_cell(), kGrass,
      [](double range_m) {
        return (2.0 * kRadius_m * kHeight_m + kHeight_m * kHeight_m - range_m * range_m) /
               (2.0 * range_m * kRadius_m);
      },
      [](double range_m) {
        return std::asin((range_m * range_m + 2.0 * kRadius_m * kHeight_m + kHeight_m * kHeight_m) /
                         (2.0 * range_m * (kRadius_m + kHeight_m)));
      });
  CHECK(error.empty == 0);
  CHECK(error.largest_dB < 0.5);
  // Without the curvature term the far cells would be 0.14 dB off for a constant gamma, more for
  // the grass law here.
  CHECK(std::abs(error.mean_dB) < 0.02);
}

TEST_CASE("R01 constant sigma0 falls with R^-3 between cells: -9.0309 dB per doubling", "[flat]") {
  sensors::Sensor sensor = tests::hivision(4);
  // A beam without elevation pattern leaves the range law alone.
  sensor.antenna.elevation.half_power_width_rad = core::radians(170.0);
  sensor.antenna.elevation.cut_rad = core::radians(80.0);
  const renderer::World world = tests::world(sensor, flat_ground(), {kConstant});
  const renderer::Frame frame = renderer::render_frame(
      world, renderer::sampling_for(16.0), {true, false}, {}, tests::level_pose(kHeight_m));
  const auto power_W = [&](int cell) {
    return frame.bscope_W[static_cast<std::size_t>(cell * sensor.scan.columns + 1)];
  };
  // Cells whose middles lie at R and 2R: k2 = 2 k1 + (minimum + cell / 2) / cell.
  const int near = 120;
  const double range_m = sensor.range.minimum_m + (near + 0.5) * sensor.range.cell_m;
  const double far = (2.0 * range_m - sensor.range.minimum_m) / sensor.range.cell_m - 0.5;
  const int low = static_cast<int>(std::floor(far));
  const double share = far - low;
  const double far_W =
      std::exp((1.0 - share) * std::log(power_W(low)) + share * std::log(power_W(low + 1)));
  // 1 / cos psi changes by 0.0015 dB between 1 km and 2 km at 60 m.
  CHECK(10.0 * std::log10(far_W / power_W(near)) == Approx(-9.0309).epsilon(0.0).margin(0.05));
}
