// Windows against the table of their figures (N = 1024, periodic form), and Taylor's width as the
// range resolution of a 250 MHz radar.
#include "signal/fourier/window.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/fourier/peak_fit.h"
#include "signal/fourier/window_figures.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

struct WindowRow {
  const char* name;
  Window window;
  double width_bins, side_lobe_dB, noise_bins, loss_dB, scalloping_dB, bias, bias_padded, variance;
};

const WindowRow kTable[] = {
    {"rectangular", {}, 0.8858, -13.26, 1.0000, 0.000, 3.922, 0.167, 0.00105, 1.000},
    {"Hann",
     {.kind = WindowKind::hann},
     1.4406,
     -31.47,
     1.5000,
     1.761,
     1.424,
     0.0160,
     0.00019,
     2.343},
    {"Hamming",
     {.kind = WindowKind::hamming},
     1.3029,
     -42.67,
     1.3628,
     1.344,
     1.751,
     0.0160,
     0.00020,
     1.644},
    {"Blackman",
     {.kind = WindowKind::blackman},
     1.6437,
     -58.11,
     1.7268,
     2.372,
     1.099,
     0.0066,
     0.00009,
     3.139},
    {"Blackman-Harris",
     {.kind = WindowKind::blackman_harris},
     1.8994,
     -92.01,
     2.0044,
     3.020,
     0.826,
     0.0032,
     0.00005,
     4.656},
    {"Taylor 4/30",
     {WindowKind::taylor, 4, 30.0},
     1.1243,
     -30.23,
     1.1714,
     0.687,
     2.360,
     0.0417,
     0.00038,
     1.197},
    {"Taylor 5/35",
     {WindowKind::taylor, 5, 35.0},
     1.1869,
     -35.10,
     1.2370,
     0.924,
     2.113,
     0.0284,
     0.00030,
     1.329},
    {"Taylor 6/45",
     {WindowKind::taylor, 6, 45.0},
     1.3043,
     -44.93,
     1.3635,
     1.347,
     1.747,
     0.0164,
     0.00020,
     1.655},
    {"Chebyshev 60",
     {WindowKind::chebyshev, 0, 60.0},
     1.4465,
     -56.6,
     1.5180,
     1.813,
     1.421,
     0.0097,
     0.00013,
     2.169},
    {"Kaiser 8.6",
     {.kind = WindowKind::kaiser, .kaiser_beta = 8.6},
     1.6369,
     -63.3,
     1.7214,
     2.359,
     1.109,
     0.0061,
     0.00009,
     3.073},
};

// Largest error, in bins of the unpadded transform, of the parabola through the logarithms of the
// three highest lines of a lone tone, without noise. `padding`: transform over window in length.
double tone_bias_bins(const std::vector<double>& weights, int padding) {
  const auto count = static_cast<double>(weights.size());
  constexpr int kPlaces = 50;
  double worst = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double place = 0.5 * i / kPlaces;  // in padded bins
    const auto line = [&](int k) {
      std::complex<double> sum = 0.0;
      for (std::size_t n = 0; n < weights.size(); ++n) {
        const double turn = (k - place) / padding * static_cast<double>(n) / count;
        sum += weights[n] * std::polar(1.0, -2.0 * core::kPi * turn);
      }
      return std::norm(sum);
    };
    const double found = log_parabola_peak(line(-1), line(0), line(1)).offset;
    worst = std::max(worst, std::abs(found - place) / padding);
  }
  return worst;
}

}  // namespace

TEST_CASE("the figures of every window are those of the table", "[window]") {
  for (const WindowRow& row : kTable) {
    INFO(row.name);
    const auto weights = window_weights(row.window, 1024);
    const WindowFigures figures = window_figures(weights);
    // Some of the table's widths are cut off, not rounded.
    CHECK(figures.half_power_width_bins == Approx(row.width_bins).margin(0.000105).epsilon(0.0));
    // The table gives two of the levels to one digit only.
    const double digit = row.side_lobe_dB == -56.6 || row.side_lobe_dB == -63.3 ? 0.06 : 0.01;
    CHECK(peak_side_lobe_dB(weights) == Approx(row.side_lobe_dB).margin(digit).epsilon(0.0));
    CHECK(figures.noise_bandwidth_bins == Approx(row.noise_bins).margin(0.00006).epsilon(0.0));
    CHECK(figures.snr_loss_dB == Approx(row.loss_dB).margin(0.0006).epsilon(0.0));
    CHECK(figures.scalloping_dB == Approx(row.scalloping_dB).margin(0.0006).epsilon(0.0));
    CHECK(figures.variance_ratio == Approx(row.variance).epsilon(0.001));
    CHECK(tone_bias_bins(weights, 1) == Approx(row.bias).epsilon(0.01).margin(0.00005));
    CHECK(tone_bias_bins(weights, 4) == Approx(row.bias_padded).epsilon(0.01).margin(0.000005));
  }
}

TEST_CASE("Taylor's half-power width is the 0.7 m of a 250 MHz radar, not its 0.6 m cell",
          "[window]") {
  const double cell_m = core::kSpeedOfLight_mps / (2.0 * 250e6);
  const auto figures = window_figures(window_weights({WindowKind::taylor, 5, 35.0}, 1024));
  CHECK(figures.half_power_width_bins * cell_m == Approx(0.7117).margin(0.00006).epsilon(0.0));
}

TEST_CASE("windows are periodic: symmetric about N / 2, and repeating after N", "[window]") {
  for (const WindowRow& row : kTable)
    for (const int length : {2, 7, 16, 125}) {
      INFO(row.name << " of " << length);
      const auto weights = window_weights(row.window, length);
      REQUIRE(weights.size() == static_cast<std::size_t>(length));
      for (int n = 1; n < length; ++n)
        REQUIRE(weights[static_cast<std::size_t>(n)] ==
                Approx(weights[static_cast<std::size_t>(length - n)]).margin(1e-12).epsilon(0.0));
    }
  CHECK(window_weights({.kind = WindowKind::hann}, 1) == std::vector<double>{1.0});
}

TEST_CASE("the side lobes of a symmetric Dolph window are all at its level", "[window]") {
  // The N + 1 weights are those that the periodic form drops the last of.
  auto weights = window_weights({WindowKind::chebyshev, 0, 60.0}, 64);
  weights.push_back(weights[0]);
  CHECK(peak_side_lobe_dB(weights) == Approx(-60.0).margin(1e-4).epsilon(0.0));
}

TEST_CASE("designs of side lobes hold their level in the symmetric form, of few weights too",
          "[window]") {
  // Twelve channels of an array under the usual taper; -28.2 dB where the last weight is missing.
  CHECK(peak_side_lobe_dB(window_weights({.kind = WindowKind::taylor}, 12)) > -28.5);
  CHECK(peak_side_lobe_dB(window_weights({.kind = WindowKind::taylor, .symmetric = true}, 12)) <
        -33.9);
  for (const int length : {12, 64, 255, 400}) {
    const auto weights = window_weights(
        {.kind = WindowKind::chebyshev, .level_dB = 60.0, .symmetric = true}, length);
    REQUIRE(weights.size() == static_cast<std::size_t>(length));
    CHECK(weights.front() == weights.back());
    CHECK(peak_side_lobe_dB(weights) == Approx(-60.0).margin(2e-3).epsilon(0.0));
  }
  CHECK(window_weights({.kind = WindowKind::hann, .symmetric = true}, 2) ==
        std::vector<double>{1.0, 1.0});
}

TEST_CASE("windows outside their range are refused", "[window]") {
  CHECK_THROWS_AS(window_weights({}, 0), core::InputError);
  CHECK_THROWS_AS(window_weights({WindowKind::taylor, 0, 35.0}, 8), core::InputError);
  CHECK_THROWS_AS(window_weights({WindowKind::taylor, 5, std::nan("")}, 8), core::InputError);
  CHECK_THROWS_AS(window_weights({WindowKind::chebyshev, 5, 5.0}, 8), core::InputError);
  CHECK_THROWS_AS(window_weights({.kind = WindowKind::kaiser, .kaiser_beta = -1.0}, 8),
                  core::InputError);
  CHECK_THROWS_AS(window_figures({1.0, 1.0}), core::InputError);
  CHECK_THROWS_AS(peak_side_lobe_dB({1.0, 1.0}), core::InputError);
}

// The width was infinite, and of a radar of three chirps that of its clusters was refused.
TEST_CASE("A window that is one weight among zeros is as wide as the whole axis", "[window]") {
  const Window hann{.kind = WindowKind::hann, .symmetric = true};
  CHECK(window_figures(window_weights(hann, 3)).half_power_width_bins == 3.0);
  CHECK(window_figures(window_weights(hann, 4)).half_power_width_bins < 4.0);
  const Window narrow{.kind = WindowKind::kaiser, .kaiser_beta = 100.0, .symmetric = true};
  CHECK(window_figures(window_weights(narrow, 9)).half_power_width_bins == 9.0);
}
