// The range-Doppler transform: calibration, places of the cells, noise, independence of threads.
#include "signal/transform/range_doppler.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "signal/fourier/fft.h"
#include "signal/transform/cube_maps.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

// As the header's equation says, cell by cell.
template <typename Real>
std::complex<double> direct_cell(const Cube<Real>& beat, const RangeDopplerSettings& settings,
                                 int channel, int doppler, int range, int doppler_length,
                                 int range_length) {
  const auto w = window_weights(settings.range_window, beat.shape.samples);
  const auto u = window_weights(settings.doppler_window, beat.shape.chirps);
  std::complex<double> sum = 0.0;
  double scale_w = 0.0;
  double scale_u = 0.0;
  for (const double weight : w) scale_w += weight;
  for (const double weight : u) scale_u += weight;
  for (int m = 0; m < beat.shape.chirps; ++m)
    for (int n = 0; n < beat.shape.samples; ++n)
      sum += w[static_cast<std::size_t>(n)] * u[static_cast<std::size_t>(m)] *
             std::complex<double>(beat.at(channel, m, n)) *
             std::polar(
                 1.0, -2.0 * core::kPi *
                          (static_cast<double>(range) * n / range_length +
                           static_cast<double>(doppler - doppler_length / 2) * m / doppler_length));
  return sum / (scale_w * scale_u);
}

template <typename Real>
void check_against_direct(const CubeShape& shape, const RangeDopplerSettings& settings,
                          double tolerance) {
  Cube<Real> beat(shape);
  tests::add_noise(beat, 1.0, 5);
  Cube<Real> result;
  range_doppler(beat, settings, result);
  const int range_length = settings.range_length == 0 ? shape.samples : settings.range_length;
  const int kept = settings.kept_range_cells == 0 ? range_length : settings.kept_range_cells;
  REQUIRE(result.shape.samples == kept);
  for (int c = 0; c < shape.channels; ++c)
    for (int d = 0; d < result.shape.chirps; d += 3)
      for (int r = 0; r < kept; r += 5)
        REQUIRE(std::abs(std::complex<double>(result.at(c, d, r)) -
                         direct_cell(beat, settings, c, d, r, result.shape.chirps, range_length)) <
                tolerance);
}

}  // namespace

TEST_CASE("the transform is the double sum, for odd sizes, padding and narrow cubes too",
          "[range_doppler]") {
  const RangeDopplerSettings plain;
  RangeDopplerSettings padded{.range_window = {.kind = WindowKind::hann},
                              .doppler_window = {.kind = WindowKind::blackman},
                              .range_length = 90,
                              .doppler_length = 33,
                              .kept_range_cells = 41};
  for (const CubeShape& shape : {CubeShape{64, 32, 2}, CubeShape{61, 15, 3}, CubeShape{5, 1, 1}}) {
    check_against_direct<double>(shape, plain, 1e-13);
    check_against_direct<float>(shape, plain, 1e-6);
  }
  check_against_direct<double>({81, 32, 2}, padded, 1e-13);
  check_against_direct<float>({81, 32, 2}, padded, 1e-6);
}

TEST_CASE("a lone tone keeps its power at its cell under every window", "[range_doppler]") {
  for (const WindowKind kind : {WindowKind::rectangular, WindowKind::hann, WindowKind::taylor,
                                WindowKind::blackman_harris, WindowKind::chebyshev}) {
    FloatCube beat({128, 64, 2});
    tests::add_tone(beat, 30.0, -12.0, 3.0, 0.7);
    FloatCube result;
    range_doppler(beat, {.range_window = {.kind = kind}, .doppler_window = {.kind = kind}}, result);
    CHECK(std::norm(result.at(0, 32 - 12, 30)) == Approx(9.0).epsilon(1e-5));
    CHECK(std::norm(result.at(1, 32 - 12, 30)) == Approx(9.0).epsilon(1e-5));
    CHECK(std::arg(result.at(1, 20, 30)) - std::arg(result.at(0, 20, 30)) ==
          Approx(0.7).margin(1e-5).epsilon(0.0));
  }
}

TEST_CASE("Parseval's sum holds along each axis of a float cube to 1e-6", "[range_doppler][fft]") {
  FloatCube cube({512, 64, 8});
  tests::add_noise(cube, 1.0, 6);
  const auto energy = [](const FloatCube& c) {
    double sum = 0.0;
    for (const auto& value : c.values) sum += std::norm(std::complex<double>(value));
    return sum;
  };
  const int plane = cube.shape.samples * cube.shape.chirps;
  const FftLayout along_samples{512, 1, 64 * 8, 512};
  const FftLayout along_channels{8, plane, plane, 1};
  for (const FftLayout& layout : {along_samples, along_channels}) {
    FloatCube lines = cube;
    Fft<float>(layout, FftDirection::forward).run(lines.values.data());
    CHECK(energy(lines) == Approx(layout.length * energy(cube)).epsilon(1e-6));
  }
  // Both transforms together: rectangular windows, calibrated by 1 / (N M).
  FloatCube result;
  const Window none;
  range_doppler(cube, {.range_window = none, .doppler_window = none}, result);
  CHECK(energy(result) * 512.0 * 64.0 == Approx(energy(cube)).epsilon(1e-6));
}

TEST_CASE("noise in a cell is the sample's times both windows' noise gain", "[range_doppler]") {
  FloatCube cube({256, 128, 4});
  tests::add_noise(cube, 2.0, 7);
  FloatCube result;
  const RangeDopplerSettings settings;
  range_doppler(cube, settings, result);
  double sum = 0.0;
  for (const auto& value : result.values) sum += std::norm(std::complex<double>(value));
  const double expected = 2.0 * noise_gain(window_weights(settings.range_window, 256)) *
                          noise_gain(window_weights(settings.doppler_window, 128));
  // 131072 cells, about 1 / 1.24^2 of them independent: 3 sigma is 1 %.
  CHECK(sum / static_cast<double>(result.values.size()) == Approx(expected).epsilon(0.01));
  CHECK(noise_gain(window_weights({.kind = WindowKind::hann}, 64)) == Approx(1.5 / 64.0));
}

TEST_CASE("the bits do not depend on the number of threads", "[range_doppler]") {
  FloatCube cube({64, 48, 5});
  tests::add_noise(cube, 1.0, 8);
  FloatCube one_thread;
  FloatCube many;
  {
    const core::ThreadLimit limit(1);
    range_doppler(cube, {}, one_thread);
  }
  range_doppler(cube, {}, many);
  CHECK(one_thread.values == many.values);
}

TEST_CASE("cells are told in metres and metres per second", "[range_doppler]") {
  // 256 chirps of 20 us, 250 MHz at 76 GHz, 20 MHz complex samples.
  const double wavelength_m = core::kSpeedOfLight_mps / 76e9;
  const RangeDopplerAxes axes =
      range_doppler_axes(20e6, 250e6 / 20e-6, 20e-6, wavelength_m, 400, 256);
  CHECK(axes.range_step_m == Approx(0.599585).margin(5e-7).epsilon(0.0));
  CHECK(axes.range_m(400, 0.0) == Approx(239.834).margin(1e-3).epsilon(0.0));
  CHECK(axes.speed_mps(129) == Approx(0.38522).margin(5e-6).epsilon(0.0));
  CHECK(axes.speed_mps(0) == Approx(-49.308).margin(5e-4).epsilon(0.0));
  // A closing target of 100 km/h reads 0.1689 m short before the shift is taken off.
  const double doppler_Hz = 2.0 * (-100.0 / 3.6) / wavelength_m;
  CHECK(axes.range_m(0.0, doppler_Hz) == Approx(0.1689).margin(5e-5).epsilon(0.0));
}

TEST_CASE("cubes and lengths that do not fit are refused", "[range_doppler]") {
  FloatCube result;
  CHECK_THROWS_AS(range_doppler(FloatCube({0, 4, 1}), {}, result), core::InputError);
  CHECK_THROWS_AS(range_doppler(FloatCube({8, 4, 1}), {.range_length = 7}, result),
                  core::InputError);
  CHECK_THROWS_AS(range_doppler(FloatCube({8, 4, 1}), {.doppler_length = 3}, result),
                  core::InputError);
  CHECK_THROWS_AS(range_doppler(FloatCube({8, 4, 1}), {.kept_range_cells = 9}, result),
                  core::InputError);
  FloatCube short_of_values({8, 4, 1});
  short_of_values.values.pop_back();
  CHECK_THROWS_AS(range_doppler(short_of_values, {}, result), core::InputError);
  CHECK_THROWS_AS(range_doppler_axes(1e6, -1.0, 1e-3, 4e-3, 8, 8), core::InputError);
}

TEST_CASE("maps keep the strongest cell or the sum along the axis that goes", "[cube_maps]") {
  DoubleCube cube({3, 2, 2});
  for (std::size_t i = 0; i < cube.values.size(); ++i)
    cube.values[i] = static_cast<double>(i % 5) + 1.0;
  const auto power = [&](int c, int m, int n) { return std::norm(cube.at(c, m, n)); };
  const PowerMap doppler_sum = range_doppler_map(cube, Projection::sum);
  const PowerMap azimuth_max = range_azimuth_map(cube, Projection::max);
  REQUIRE(doppler_sum.rows == 2);
  REQUIRE(azimuth_max.rows == 2);
  for (int i = 0; i < 2; ++i)
    for (int n = 0; n < 3; ++n) {
      CHECK(doppler_sum.at(i, n) == Approx(power(0, i, n) + power(1, i, n)));
      CHECK(azimuth_max.at(i, n) == Approx(std::max(power(i, 0, n), power(i, 1, n))));
    }
  CHECK(range_azimuth_map(cube, Projection::sum).at(0, 1) ==
        Approx(power(0, 0, 1) + power(0, 1, 1)));
  CHECK(range_doppler_map(cube, Projection::max).at(1, 2) ==
        Approx(std::max(power(0, 1, 2), power(1, 1, 2))));
}
