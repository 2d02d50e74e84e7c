#include "sensors/receiver/point_response.h"

#include <cmath>

#include "core/constants.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/antenna/frequency_scan.h"
#include "sensors/cells.h"

namespace fanbeam::sensors {
namespace {

using Window = Waveform::Window;

constexpr double kLn2 = 0.69314718055994530942;

// Taylor's F_m for n-bar nearly equal side lobes (Taylor 1955).
std::vector<double> taylor_coefficients(double side_lobe, int equal_lobes) {
  const double a = std::acosh(1.0 / std::sqrt(side_lobe)) / core::kPi;
  const double n = equal_lobes;
  const double dilation = n * n / (a * a + (n - 0.5) * (n - 0.5));
  std::vector<double> coefficients = {1.0};
  for (int m = 1; m < equal_lobes; ++m) {
    double numerator = m % 2 == 1 ? 0.5 : -0.5;
    double denominator = 1.0;
    for (int i = 1; i < equal_lobes; ++i) {
      const double zero = dilation * (a * a + (i - 0.5) * (i - 0.5));
      numerator *= 1.0 - m * m / zero;
      if (i != m) denominator *= 1.0 - static_cast<double>(m * m) / (i * i);
    }
    coefficients.push_back(numerator / denominator);
  }
  return coefficients;
}

// Radians of scan per hertz of sweep where the column looks.
double sweep_rate_rad_per_Hz(const Sensor& sensor, int column) {
  if (sensor.scan.frequency_scan)
    return steering_rate_rad_per_Hz(*sensor.scan.frequency_scan,
                                    column_middle_rad(sensor.scan, column));
  return sensor.scan.field_of_view_rad / sensor.waveform.bandwidth_Hz;
}

double window_field(const std::vector<double>& coefficients, double x) {
  double sum = coefficients[0] * normalised_sinc(x);
  for (std::size_t m = 1; m < coefficients.size(); ++m) {
    const auto shift = static_cast<double>(m);
    sum += coefficients[m] * (normalised_sinc(x - shift) + normalised_sinc(x + shift));
  }
  return sum;
}

}  // namespace

std::vector<double> window_coefficients(const Waveform& waveform) {
  switch (waveform.window) {
    case Window::hann:
      return {0.5, 0.25};
    case Window::hamming:
      return {0.54, 0.23};
    case Window::taylor:
      return taylor_coefficients(waveform.taylor_side_lobe, waveform.taylor_equal_lobes);
    case Window::none:
    case Window::rectangular:
      break;
  }
  return {1.0};
}

PointResponse::PointResponse(const Sensor& sensor, int column) {
  constexpr double kHalf_c = core::kSpeedOfLight_mps / 2.0;
  if (sensor.scan.sweep == Scan::Sweep::whole_scan) {
    const double lit_Hz =
        sensor.antenna.azimuth.half_power_width_rad / sweep_rate_rad_per_Hz(sensor, column);
    scale_m_ = kHalf_c / lit_Hz * std::sqrt(kLn2) / core::kPi;
    peak_per_m_ = 1.0 / (scale_m_ * std::sqrt(2.0 * core::kPi));
    return;
  }
  coefficients_ = window_coefficients(sensor.waveform);
  double energy = coefficients_[0] * coefficients_[0];
  for (std::size_t m = 1; m < coefficients_.size(); ++m)
    energy += 2.0 * coefficients_[m] * coefficients_[m];
  scale_m_ = kHalf_c / sensor.waveform.bandwidth_Hz;
  peak_per_m_ = coefficients_[0] * coefficients_[0] / (energy * scale_m_);
}

double PointResponse::density_per_m(double offset_m) const {
  const double x = offset_m / scale_m_;
  if (coefficients_.empty()) return peak_per_m_ * std::exp(-0.5 * x * x);
  const double field = window_field(coefficients_, x) / coefficients_[0];
  return peak_per_m_ * field * field;
}

double PointResponse::half_power_width_m() const {
  if (coefficients_.empty()) return 2.0 * std::sqrt(2.0 * kLn2) * scale_m_;
  // The main lobe falls from its peak to its null, which no window has nearer than one bin.
  double inside_m = 0.0, outside_m = scale_m_;
  while (density_per_m(outside_m) > 0.5 * peak_per_m_) outside_m += 0.5 * scale_m_;
  for (int i = 0; i < 60; ++i) {
    const double middle_m = 0.5 * (inside_m + outside_m);
    (density_per_m(middle_m) > 0.5 * peak_per_m_ ? inside_m : outside_m) = middle_m;
  }
  return 2.0 * inside_m;
}

bool has_point_response(const Sensor& sensor) {
  return sensor.waveform.window != Window::none || sensor.scan.sweep == Scan::Sweep::whole_scan;
}

bool point_response_varies(const Sensor& sensor) {
  return sensor.scan.sweep == Scan::Sweep::whole_scan && sensor.scan.frequency_scan.has_value();
}

}  // namespace fanbeam::sensors
