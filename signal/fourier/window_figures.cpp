#include "signal/fourier/window_figures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"

namespace fanbeam::signal {
namespace {

using core::kPi;

// |W(f)|^2 / |W(0)|^2, f in bins.
double response(const std::vector<double>& weights, double bins) {
  std::complex<double> sum = 0.0;
  double at_zero = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const double turn = bins * static_cast<double>(n) / static_cast<double>(weights.size());
    sum += weights[n] * std::polar(1.0, -2.0 * kPi * turn);
    at_zero += weights[n];
  }
  return std::norm(sum) / (at_zero * at_zero);
}

// Of a few weights one may be all there is, with the same response over the whole axis.
double half_power_width(const std::vector<double>& weights) {
  const double farthest = 0.5 * static_cast<double>(weights.size());
  double inside = 0.0;
  double outside = 0.25;
  while (response(weights, outside) > 0.5) {
    if (outside == farthest) return 2.0 * farthest;
    inside = outside;
    outside = std::min(2.0 * outside, farthest);
  }
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (inside + outside);
    (response(weights, middle) > 0.5 ? inside : outside) = middle;
  }
  return inside + outside;
}

void check_window(const std::vector<double>& weights) {
  if (weights.size() < 3 || !(std::accumulate(weights.begin(), weights.end(), 0.0) > 0.0))
    refuse("window.weights", static_cast<double>(weights.size()),
           "three or more weights with a positive sum");
}

}  // namespace

double peak_side_lobe_dB(const std::vector<double>& weights) {
  check_window(weights);
  constexpr std::size_t kPadding = 16;
  std::vector<std::complex<double>> padded(kPadding * weights.size());
  std::copy(weights.begin(), weights.end(), padded.begin());
  const auto lines = spectrum(std::move(padded));
  const std::size_t half = lines.size() / 2;
  std::size_t k = 1;
  while (k + 1 < half && std::norm(lines[k + 1]) < std::norm(lines[k])) ++k;
  if (k + 1 >= half) return -std::numeric_limits<double>::infinity();
  std::size_t peak = k;
  for (; k < half; ++k)
    if (std::norm(lines[k]) > std::norm(lines[peak])) peak = k;
  // The lobe's top between the lines, by golden section.
  double low = static_cast<double>(peak - 1) / kPadding;
  double high = static_cast<double>(peak + 1) / kPadding;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int step = 0; step < 40; ++step) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    (response(weights, left) < response(weights, right) ? low : high) =
        response(weights, left) < response(weights, right) ? left : right;
  }
  return 10.0 * std::log10(response(weights, 0.5 * (low + high)));
}

WindowFigures window_figures(const std::vector<double>& weights) {
  check_window(weights);
  double sum = 0.0, squares = 0.0, moment = 0.0, square_moment = 0.0, plain_moment = 0.0;
  const auto count = static_cast<double>(weights.size());
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const double w = weights[n];
    const double t = static_cast<double>(n) - 0.5 * count;
    sum += w;
    squares += w * w;
    moment += t * t * w;
    square_moment += t * t * w * w;
    plain_moment += t * t;
  }
  WindowFigures figures;
  figures.half_power_width_bins = half_power_width(weights);
  figures.noise_bandwidth_bins = count * squares / (sum * sum);
  figures.snr_loss_dB = 10.0 * std::log10(figures.noise_bandwidth_bins);
  figures.scalloping_dB = -10.0 * std::log10(response(weights, 0.5));
  figures.variance_ratio = square_moment * plain_moment / (moment * moment);
  return figures;
}

}  // namespace fanbeam::signal
