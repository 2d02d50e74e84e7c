// Capon and MUSIC against the reference rates for two sources inside a beamwidth.
#include "signal/angle/spatial_spectrum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "signal/angle/covariance.h"
#include "signal/waveform/array.h"
#include "tests/signal/half_wave_line.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;
using core::radians;
using tests::kLineWavelength_m;
using tests::line_of;

namespace {

constexpr double kGridStep_deg = 0.05;

Steering grid_for(int elements) {
  std::vector<double> azimuths;
  for (int i = -600; i <= 600; ++i) azimuths.push_back(radians(kGridStep_deg * i));
  return steering_vectors(line_of(elements), kLineWavelength_m, {azimuths});
}

// Of a beam to each direction: a^H R a / N^2.
std::vector<double> fourier_spectrum(const Covariance& covariance, const Steering& grid) {
  std::vector<double> powers;
  for (int beam = 0; beam < grid.beams; ++beam) {
    std::complex<double> sum = 0.0;
    for (int i = 0; i < grid.elements; ++i)
      for (int j = 0; j < grid.elements; ++j)
        sum += std::conj(grid.at(beam, i)) * covariance.at(i, j) * grid.at(beam, j);
    powers.push_back(sum.real() / (grid.elements * grid.elements));
  }
  return powers;
}

double degrees_of(double beam) { return (beam - 600.0) * kGridStep_deg; }

// Two waves of power `snr` over noise of 1, at +-separation / 2.
Snapshots two_sources(int elements, int snapshots, double separation_deg, double snr_dB,
                      std::uint32_t trial, bool constant_modulus = false) {
  const auto waves =
      steering_vectors(line_of(elements), kLineWavelength_m,
                       {{radians(-0.5 * separation_deg), radians(0.5 * separation_deg)}});
  const double snr = std::pow(10.0, snr_dB / 10.0);
  Snapshots result;
  for (int t = 0; t < snapshots; ++t) {
    const auto cell = static_cast<std::uint64_t>(t) * 1000;
    std::complex<double> first = tests::noise(snr, cell + 900, trial);
    std::complex<double> second = tests::noise(snr, cell + 901, trial);
    if (snapshots == 1 || constant_modulus) {  // equal powers, phases at random
      first *= std::sqrt(snr) / std::abs(first);
      second *= std::sqrt(snr) / std::abs(second);
    }
    std::vector<std::complex<double>> x;
    for (int m = 0; m < elements; ++m)
      x.push_back(first * waves.at(0, m) + second * waves.at(1, m) +
                  tests::noise(1.0, cell + static_cast<std::uint64_t>(m), trial));
    result.push_back(x);
  }
  return result;
}

struct Rate {
  double share = 0.0;
  double rmse_deg = 0.0;  // where separated
};

using SpectrumMethod = std::function<std::vector<double>(const Snapshots&)>;

// Separated: the two strongest peaks are within half the spacing of the truth, one each, and the
// second is within 15 dB of the first.
Rate separated(const SpectrumMethod& method, int elements, int snapshots, double separation_deg,
               double snr_dB, int trials, bool constant_modulus = false) {
  Rate rate;
  int found = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto peaks = spectrum_peaks(
        method(two_sources(elements, snapshots, separation_deg, snr_dB,
                           static_cast<std::uint32_t>(7000 + trial), constant_modulus)));
    if (peaks.size() < 2 || peaks[1].power < peaks[0].power * std::pow(10.0, -1.5)) continue;
    const double a = degrees_of(std::min(peaks[0].beam, peaks[1].beam)) + 0.5 * separation_deg;
    const double b = degrees_of(std::max(peaks[0].beam, peaks[1].beam)) - 0.5 * separation_deg;
    if (std::abs(a) > 0.5 * separation_deg || std::abs(b) > 0.5 * separation_deg) continue;
    ++found;
    rate.rmse_deg += 0.5 * (a * a + b * b);
  }
  rate.rmse_deg = found > 0 ? std::sqrt(rate.rmse_deg / found) : 0.0;
  rate.share = static_cast<double>(found) / trials;
  return rate;
}

// Three standard deviations of a share over `trials`, twice over since the published one is a
// simulation of its own.
double binomial(double share, int trials) {
  return 3.0 * std::sqrt(2.0 * std::max(share * (1.0 - share), 0.01) / trials);
}

}  // namespace

TEST_CASE("Capon and MUSIC separate two sources at the reference rates", "[angle][statistics]") {
  constexpr int kElements = 12;
  constexpr int kTrials = 300;
  const Steering grid = grid_for(kElements);
  const SpectrumMethod fourier = [&](const Snapshots& s) {
    return fourier_spectrum(sample_covariance(s), grid);
  };
  const SpectrumMethod capon = [&](const Snapshots& s) {
    return capon_spectrum(sample_covariance(s), grid);
  };
  const SpectrumMethod music = [&](const Snapshots& s) {
    return music_spectrum(sample_covariance(s), grid, 2);
  };
  struct Case {
    double separation_deg, snr_dB, capon, rmse_deg;
  };
  for (const Case& c : {Case{3.5, 10.0, 0.53, 0.18}, Case{2.0, 20.0, 0.21, 0.11}}) {
    CHECK(separated(fourier, kElements, 64, c.separation_deg, c.snr_dB, kTrials).share == 0.0);
    const Rate by_capon = separated(capon, kElements, 64, c.separation_deg, c.snr_dB, kTrials);
    const Rate by_music = separated(music, kElements, 64, c.separation_deg, c.snr_dB, kTrials);
    INFO(c.separation_deg << " deg: Capon " << by_capon.share << ", MUSIC " << by_music.share
                          << ", rmse " << by_music.rmse_deg);
    // At least the reference's rate. Loading of 1e-3, which an invertible matrix does not need, and
    // sources of constant modulus give that rate itself (below).
    CHECK(by_capon.share > c.capon - binomial(c.capon, kTrials));
    CHECK(by_capon.share < 0.75);
    CHECK(by_music.share >= 0.99);
    CHECK(by_music.rmse_deg == Approx(c.rmse_deg).epsilon(0.1));
  }
}

TEST_CASE("Capon with a loading of 1e-3 has the reference rates", "[angle][statistics]") {
  constexpr int kTrials = 300;
  const Steering grid = grid_for(12);
  const SpectrumMethod loaded = [&](const Snapshots& s) {
    return capon_spectrum(sample_covariance(s), grid, 1e-3);
  };
  // Twice the trials without the loading separate at 2 deg.
  const double near = separated(loaded, 12, 64, 2.0, 20.0, kTrials, true).share;
  const double wide = separated(loaded, 12, 64, 3.5, 10.0, kTrials, true).share;
  CHECK(near == Approx(0.21).margin(binomial(0.21, kTrials)).epsilon(0.0));
  CHECK(wide == Approx(0.53).margin(binomial(0.53, kTrials)).epsilon(0.0));
}

TEST_CASE("smoothing separates two sources in one snapshot at the reference rates",
          "[angle][statistics]") {
  constexpr int kTrials = 500;
  const Steering whole = grid_for(12);
  const Steering grid = grid_for(8);
  const SpectrumMethod fourier = [&](const Snapshots& s) {
    return fourier_spectrum(sample_covariance(s), whole);
  };
  const SpectrumMethod capon = [&](const Snapshots& s) {
    return capon_spectrum(smoothed_covariance(s, 8), grid, 1e-3);
  };
  const SpectrumMethod music = [&](const Snapshots& s) {
    return music_spectrum(smoothed_covariance(s, 8), grid, 2);
  };
  const double by_fourier = separated(fourier, 12, 1, 6.0, 20.0, kTrials).share;
  const double by_capon = separated(capon, 12, 1, 6.0, 20.0, kTrials).share;
  const Rate music20 = separated(music, 12, 1, 6.0, 20.0, kTrials);
  const Rate music30 = separated(music, 12, 1, 6.0, 30.0, kTrials);
  INFO("Fourier " << by_fourier << ", Capon " << by_capon << ", MUSIC " << music20.share << " ("
                  << music20.rmse_deg << "), at 30 dB " << music30.share << " (" << music30.rmse_deg
                  << ")");
  CHECK(by_fourier == Approx(0.19).margin(binomial(0.19, kTrials)).epsilon(0.0));
  CHECK(by_capon >= 0.94 - binomial(0.94, kTrials));
  CHECK(music20.share == Approx(0.98).margin(binomial(0.98, kTrials)).epsilon(0.0));
  CHECK(music20.rmse_deg == Approx(0.51).epsilon(0.15));
  CHECK(music30.share >= 0.99);
  CHECK(music30.rmse_deg == Approx(0.15).epsilon(0.15));
}

TEST_CASE("a lone source has its power in the Capon spectrum", "[angle]") {
  // Exact covariance: p a a^H + s2 I.
  const Steering grid = grid_for(8);
  Covariance covariance{8, std::vector<std::complex<double>>(64)};
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column)
      covariance.at(row, column) =
          5.0 * grid.at(700, row) * std::conj(grid.at(700, column)) + (row == column ? 0.4 : 0.0);
  CHECK(capon_spectrum(covariance, grid)[700] == Approx(5.0 + 0.4 / 8.0));
  CHECK(spectrum_peaks(music_spectrum(covariance, grid, 1))[0].beam ==
        Approx(700.0).margin(0.01).epsilon(0.0));
  CHECK(spectrum_peaks({1.0, 2.0}).empty());
}

TEST_CASE("smoothing is the mean over shifted sub-arrays, forwards and backwards", "[angle]") {
  const Snapshots one = two_sources(5, 1, 10.0, 10.0, 1);
  const Covariance smoothed = smoothed_covariance(one, 3);
  const auto& x = one[0];
  std::complex<double> expected = 0.0;
  for (std::size_t l = 0; l < 3; ++l)
    expected += x[l] * std::conj(x[l + 2]) + std::conj(x[l + 2]) * x[l];
  CHECK(std::abs(smoothed.at(0, 2) - expected / 6.0) < 1e-12);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      CHECK(std::abs(smoothed.at(row, column) - std::conj(smoothed.at(column, row))) < 1e-12);
      // Persymmetric: J conj(R) J = R.
      CHECK(std::abs(smoothed.at(row, column) - std::conj(smoothed.at(2 - row, 2 - column))) <
            1e-12);
    }
}

TEST_CASE("covariances that cannot be made or inverted", "[angle]") {
  CHECK_THROWS_AS(sample_covariance({}), core::InputError);
  CHECK_THROWS_AS(sample_covariance({{1.0, 2.0}, {1.0}}), core::InputError);
  CHECK_THROWS_AS(sample_covariance({{1.0, std::nan("")}}), core::InputError);
  CHECK_THROWS_AS(smoothed_covariance({{1.0, 2.0}}, 3), core::InputError);
  const Steering grid = grid_for(4);
  const Covariance zero{4, std::vector<std::complex<double>>(16)};
  for (const double power : capon_spectrum(zero, grid)) REQUIRE(power == 0.0);
  CHECK_THROWS_AS(music_spectrum(zero, grid, 4), core::InputError);
  CHECK_THROWS_AS(capon_spectrum(zero, grid_for(3)), core::InputError);
}
