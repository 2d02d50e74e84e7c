#include "signal/fourier/window.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <initializer_list>

#include "core/constants.h"
#include "signal/checks_private.h"
#include "signal/fourier/fft.h"

namespace fanbeam::signal {
namespace {

using core::kPi;

// a0 - a1 cos 2 pi u + a2 cos 4 pi u - ...
std::vector<double> cosine_sum(std::initializer_list<double> terms, int length) {
  std::vector<double> weights(static_cast<std::size_t>(length));
  for (int n = 0; n < length; ++n) {
    double sum = 0.0;
    double sign = 1.0;
    int order = 0;
    for (const double term : terms) {
      sum += sign * term * std::cos(2.0 * kPi * order * n / length);
      sign = -sign;
      ++order;
    }
    weights[static_cast<std::size_t>(n)] = sum;
  }
  return weights;
}

double taylor_coefficient(int m, int nbar, double a_squared, double widening) {
  double numerator = 1.0;
  double denominator = 1.0;
  for (int i = 1; i < nbar; ++i) {
    numerator *= 1.0 - m * m / (widening * (a_squared + (i - 0.5) * (i - 0.5)));
    if (i != m) denominator *= 1.0 - static_cast<double>(m * m) / (i * i);
  }
  return (m % 2 == 1 ? 0.5 : -0.5) * numerator / denominator;
}

std::vector<double> taylor(int nbar, double level_dB, int length) {
  core::require_range("window.taylor_nbar", nbar, {1.0, 50.0});
  core::require_range("window.level_dB", level_dB, {10.0, 120.0}, "dB");
  const double a = std::acosh(std::pow(10.0, level_dB / 20.0)) / kPi;
  const double widening = nbar * nbar / (a * a + (nbar - 0.5) * (nbar - 0.5));
  std::vector<double> weights(static_cast<std::size_t>(length), 1.0);
  for (int m = 1; m < nbar; ++m) {
    const double f = taylor_coefficient(m, nbar, a * a, widening);
    for (int n = 0; n < length; ++n)
      weights[static_cast<std::size_t>(n)] +=
          2.0 * f * std::cos(2.0 * kPi * m * (n - 0.5 * length) / (length + 1));
  }
  return weights;
}

// Chebyshev polynomial of the first kind, for any real x.
double chebyshev_polynomial(int order, double x) {
  if (std::abs(x) <= 1.0) return std::cos(order * std::acos(x));
  const double value = std::cosh(order * std::acosh(std::abs(x)));
  return x < 0.0 && order % 2 == 1 ? -value : value;
}

// Dolph's window is known by its spectrum, T_order(x0 cos(pi k / points)): equal side lobes.
std::vector<double> chebyshev(double level_dB, int length) {
  core::require_range("window.level_dB", level_dB, {20.0, 200.0}, "dB");
  const int points = length + 1;
  const int order = length;
  const double x0 = std::cosh(std::acosh(std::pow(10.0, level_dB / 20.0)) / order);
  std::vector<std::complex<double>> lines(static_cast<std::size_t>(points));
  for (int k = 0; k < points; ++k) {
    const double line = chebyshev_polynomial(order, x0 * std::cos(kPi * k / points));
    // Half a sample of delay puts an even number of points about a centre between two of them.
    lines[static_cast<std::size_t>(k)] =
        points % 2 == 1 ? line : std::polar(1.0, kPi * k / points) * line;
  }
  const auto centred = spectrum(std::move(lines));
  const auto centred_at = [&](int offset) {
    return centred[static_cast<std::size_t>(offset)].real();
  };
  std::vector<double> weights(static_cast<std::size_t>(length));
  for (int n = 0; n < length; ++n) {
    // Odd: the centre is point 0. Even: points 0 and 1 are its two neighbours.
    const int from_centre = points % 2 == 1  ? std::abs(n - length / 2)
                            : n < points / 2 ? points / 2 - n
                                             : n - points / 2 + 1;
    weights[static_cast<std::size_t>(n)] = centred_at(from_centre);
  }
  const double peak = *std::max_element(weights.begin(), weights.end());
  for (double& weight : weights) weight /= peak;
  return weights;
}

std::vector<double> kaiser(double beta, int length) {
  core::require_range("window.kaiser_beta", beta, {0.0, 100.0});
  std::vector<double> weights(static_cast<std::size_t>(length));
  for (int n = 0; n < length; ++n) {
    const double from_centre = 2.0 * n / length - 1.0;
    weights[static_cast<std::size_t>(n)] =
        std::cyl_bessel_i(0.0, beta * std::sqrt(std::max(0.0, 1.0 - from_centre * from_centre))) /
        std::cyl_bessel_i(0.0, beta);
  }
  return weights;
}

}  // namespace

std::vector<double> window_weights(const Window& window, int length) {
  if (length < 1) refuse("window.length", length, "1 or more");
  if (length == 1) return {1.0};
  if (window.symmetric) {
    Window periodic = window;
    periodic.symmetric = false;
    std::vector<double> weights = window_weights(periodic, length - 1);
    weights.push_back(weights.front());
    return weights;
  }
  switch (window.kind) {
    case WindowKind::rectangular:
      return std::vector<double>(static_cast<std::size_t>(length), 1.0);
    case WindowKind::hann:
      return cosine_sum({0.5, 0.5}, length);
    case WindowKind::hamming:
      return cosine_sum({0.54, 0.46}, length);
    case WindowKind::blackman:
      return cosine_sum({0.42, 0.5, 0.08}, length);
    case WindowKind::blackman_harris:
      return cosine_sum({0.35875, 0.48829, 0.14128, 0.01168}, length);
    case WindowKind::taylor:
      return taylor(window.taylor_nbar, window.level_dB, length);
    case WindowKind::chebyshev:
      return chebyshev(window.level_dB, length);
    case WindowKind::kaiser:
      return kaiser(window.kaiser_beta, length);
  }
  throw core::InternalError("unknown window");
}

}  // namespace fanbeam::signal
