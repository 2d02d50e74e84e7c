// Tones and scatterers to the Cramer-Rao bound.
#include "signal/detection/tone.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "signal/detection/cube_tone.h"
#include "signal/fourier/window.h"
#include "signal/fourier/window_figures.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;

TEST_CASE("a lone tone without noise is found exactly, wherever it lies", "[tone]") {
  for (const int count : {2, 3, 64, 1000})
    for (const double bin : {0.0, 0.3, 0.5, 0.999}) {
      const Tone found = strongest_tone(tests::tone(count, bin, 2.0));
      CHECK(std::remainder(found.bin - bin, count) == Approx(0.0).margin(1e-9).epsilon(0.0));
      CHECK(found.power == Approx(4.0).epsilon(1e-9));
      CHECK(std::arg(found.amplitudes[0]) == Approx(0.3).margin(1e-8).epsilon(0.0));
    }
  const Tone negative = strongest_tone(tests::tone(64, -3.25, 1.0));
  CHECK(std::remainder(negative.bin + 3.25, 64.0) == Approx(0.0).margin(1e-9).epsilon(0.0));
  const auto hann = window_weights({.kind = WindowKind::hann}, 64);
  CHECK(strongest_tone(tests::tone(64, 20.4, 1.0), hann).bin ==
        Approx(20.4).margin(1e-9).epsilon(0.0));
  CHECK(strongest_tone(std::vector<std::complex<double>>(8)).power == 0.0);
}

TEST_CASE("a window keeps a neighbour from pulling a tone", "[tone]") {
  auto samples = tests::tone(256, 40.3, 1.0);
  const auto other = tests::tone(256, 46.1, 3.0);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] += other[n];
  const auto weights = window_weights({.kind = WindowKind::blackman_harris}, 256);
  CHECK(std::abs(refined_tone({samples}, 40.3).bin - 40.3) > 0.01);
  CHECK(std::abs(refined_tone({samples}, 40.3, weights).bin - 40.3) < 0.001);
}

TEST_CASE("the frequency of a tone reaches the Cramer-Rao bound from 15 to 60 dB",
          "[tone][statistics]") {
  constexpr int kCount = 256;
  constexpr int kTrials = 2000;
  for (const double eta_dB : {15.0, 20.0, 30.0, 40.0, 50.0, 60.0}) {
    const double eta = std::pow(10.0, eta_dB / 10.0);
    const double bound = std::sqrt(6.0 / eta) / (2.0 * kPi);
    double squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const double bin = 60.0 + trial / static_cast<double>(kTrials);
      const auto samples =
          tests::tone(kCount, bin, 1.0, kCount / eta, static_cast<std::uint32_t>(1000 + trial));
      const double error = strongest_tone(samples).bin - bin;
      squares += error * error;
    }
    const double ratio = std::sqrt(squares / kTrials) / bound;
    INFO(eta_dB << " dB: " << ratio);
    CHECK(ratio < 1.10);
    CHECK(ratio > 0.95);  // 3 sigma of the estimate is 5 %
  }
}

TEST_CASE("a window costs its variance ratio", "[tone][statistics]") {
  constexpr int kCount = 256;
  constexpr int kTrials = 2000;
  const auto hann = window_weights({.kind = WindowKind::hann}, kCount);
  const double eta = 1e4;
  double squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto samples =
        tests::tone(kCount, 60.3, 1.0, kCount / eta, static_cast<std::uint32_t>(1000 + trial));
    const double error = strongest_tone(samples, hann).bin - 60.3;
    squares += error * error;
  }
  const double variance = squares / kTrials / (6.0 / eta / (4.0 * kPi * kPi));
  // 3 sigma of a variance over 2000 trials is 9.5 %.
  CHECK(variance == Approx(window_figures(hann).variance_ratio).epsilon(0.095));
}

TEST_CASE("independent ramps average as 1 / sqrt(n)", "[tone][statistics]") {
  // 100 m, 10 m2: 56.45 dB per 2 ms ramp of 250 MHz gives 0.352 mm.
  const double cell_m = core::kSpeedOfLight_mps / (2.0 * 250e6);
  const double eta = std::pow(10.0, 5.645);
  constexpr int kCount = 64;
  constexpr int kTrials = 400;
  for (const int ramps : {1, 4, 16}) {
    double squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      ToneRecords records;
      for (int ramp = 0; ramp < ramps; ++ramp)
        records.push_back(tests::tone(kCount, 20.2, 1.0, kCount / eta,
                                      static_cast<std::uint32_t>(5000 + trial * 16 + ramp)));
      const double error_m = (refined_tone(records, 20.0).bin - 20.2) * cell_m;
      squares += error_m * error_m;
    }
    // 3 sigma over 400 trials is 11 %.
    CHECK(std::sqrt(squares / kTrials) == Approx(0.352e-3 / std::sqrt(ramps)).epsilon(0.11));
  }
}

TEST_CASE("range and Doppler of a scatterer in a cube reach their bounds",
          "[cube_tone][statistics]") {
  constexpr int kTrials = 500;
  const CubeShape shape{48, 24, 3};
  for (const double eta_dB : {18.0, 40.0}) {
    const double eta = std::pow(10.0, eta_dB / 10.0);
    const double bound = std::sqrt(6.0 / eta) / (2.0 * kPi);
    double range_squares = 0.0;
    double doppler_squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      DoubleCube cube(shape);
      tests::add_tone(cube, 10.3, -4.4, 1.0, 1.1);
      tests::add_noise(cube, static_cast<double>(shape.count()) / eta,
                       static_cast<std::uint32_t>(2000 + trial));
      const CubeTone found = refined_in_cube(cube, 10.0, -4.0);
      range_squares += std::pow(found.range_bin - 10.3, 2);
      doppler_squares += std::pow(found.doppler_bin + 4.4, 2);
    }
    INFO(eta_dB << " dB: range " << std::sqrt(range_squares / kTrials) / bound << ", Doppler "
                << std::sqrt(doppler_squares / kTrials) / bound);
    CHECK(std::sqrt(range_squares / kTrials) < 1.10 * bound);
    CHECK(std::sqrt(doppler_squares / kTrials) < 1.10 * bound);
    // 3 sigma over 500 trials is 10 %.
    CHECK(std::sqrt(range_squares / kTrials) > 0.9 * bound);
    CHECK(std::sqrt(doppler_squares / kTrials) > 0.9 * bound);
  }
}

TEST_CASE("the snapshot of a scatterer is that of the cube's middle", "[cube_tone]") {
  FloatCube cube({32, 16, 4});
  tests::add_tone(cube, 7.25, 3.6, 2.0, -0.4);
  const CubeTone found = refined_in_cube(cube, 7.0, 4.0);
  CHECK(found.range_bin == Approx(7.25).margin(1e-5).epsilon(0.0));
  CHECK(found.doppler_bin == Approx(3.6).margin(1e-5).epsilon(0.0));
  const double middle = 2.0 * kPi * (7.25 * 15.5 / 32.0 + 3.6 * 7.5 / 16.0);
  for (int c = 0; c < 4; ++c)
    CHECK(std::abs(found.snapshot[static_cast<std::size_t>(c)] -
                   std::polar(2.0, middle - 0.4 * c)) < 1e-4);
}

TEST_CASE("records and cubes that do not fit are refused", "[tone]") {
  CHECK_THROWS_AS(refined_tone({}, 0.0), core::InputError);
  CHECK_THROWS_AS(refined_tone({{1.0}}, 0.0), core::InputError);
  CHECK_THROWS_AS(refined_tone({{1.0, 1.0}, {1.0}}, 0.0), core::InputError);
  CHECK_THROWS_AS(refined_tone({{1.0, std::nan("")}}, 0.0), core::InputError);
  CHECK_THROWS_AS(refined_tone({{1.0, 1.0}}, 0.0, {1.0}), core::InputError);
  CHECK_THROWS_AS(refined_in_cube(DoubleCube({1, 8, 1}), 0.0, 0.0), core::InputError);
}
