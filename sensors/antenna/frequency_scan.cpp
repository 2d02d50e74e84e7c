#include "sensors/antenna/frequency_scan.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "sensors/cells.h"

namespace fanbeam::sensors {
namespace {

using Law = FrequencyScan::Law;

// m c / d: the frequency whose wavelength is d / m.
double order_Hz(const FrequencyScan& scan) {
  return scan.mode * core::kSpeedOfLight_mps / scan.spacing_m;
}

// The row below `value` in increasing `rows`, for interpolation up to its successor.
std::optional<std::size_t> row_below(const std::vector<double>& rows, double value) {
  if (rows.size() < 2 || !(value >= rows.front() && value <= rows.back())) return std::nullopt;
  const auto above = std::upper_bound(rows.begin(), rows.end(), value);
  return std::min(static_cast<std::size_t>(above - rows.begin()), rows.size() - 1) - 1;
}

std::optional<double> interpolated(const std::vector<double>& from, const std::vector<double>& to,
                                   double value) {
  const auto i = row_below(from, value);
  if (!i) return std::nullopt;
  return to[*i] + (value - from[*i]) / (from[*i + 1] - from[*i]) * (to[*i + 1] - to[*i]);
}

}  // namespace

// With x = 1/f, s = sin(theta), A = L/d and B = m c / d the law s + B x = A sqrt(1 - (fc x)^2) is
// the quadratic (B^2 + A^2 fc^2) x^2 + 2 s B x + s^2 - A^2 = 0, whose positive root counts.
std::optional<double> frequency_towards_Hz(const FrequencyScan& scan, double azimuth_rad) {
  if (scan.law == Law::table)
    return interpolated(scan.table_azimuth_rad, scan.table_frequency_Hz, azimuth_rad);
  const double s = std::sin(azimuth_rad);
  const double A = scan.line_length_per_spacing;
  const double B = order_Hz(scan);
  const double square = B * B + A * A * scan.cutoff_Hz * scan.cutoff_Hz;
  const double discriminant = s * s * B * B + square * (A * A - s * s);
  if (!(std::abs(azimuth_rad) <= core::kPi / 2) || !(square > 0.0) || !(discriminant >= 0.0))
    return std::nullopt;
  const double root = std::sqrt(discriminant);
  // 1/x, by the form of the root that does not cancel.
  const double frequency_Hz = s > 0.0 ? (s * B + root) / (A * A - s * s) : square / (root - s * B);
  const bool points_there = frequency_Hz > 0.0 && s * frequency_Hz + B >= 0.0;
  return points_there && std::isfinite(frequency_Hz) ? std::optional(frequency_Hz) : std::nullopt;
}

double steering_rate_rad_per_Hz(const FrequencyScan& scan, double azimuth_rad) {
  if (scan.law == Law::table) {
    const auto i = row_below(scan.table_azimuth_rad, azimuth_rad);
    if (!i) return 0.0;
    return (scan.table_azimuth_rad[*i + 1] - scan.table_azimuth_rad[*i]) /
           (scan.table_frequency_Hz[*i + 1] - scan.table_frequency_Hz[*i]);
  }
  const auto frequency_Hz = frequency_towards_Hz(scan, azimuth_rad);
  if (!frequency_Hz) return 0.0;
  const double f = *frequency_Hz;
  const double cut = scan.cutoff_Hz / f;
  const double slope =
      scan.line_length_per_spacing * cut * cut / std::sqrt((1.0 - cut) * (1.0 + cut)) / f +
      order_Hz(scan) / (f * f);
  return slope / std::cos(azimuth_rad);
}

SteeredColumn steered_column(const Sensor& sensor, int column) {
  const FrequencyScan& scan = *sensor.scan.frequency_scan;
  SteeredColumn steered;
  steered.azimuth_rad = column_middle_rad(sensor.scan, column);
  steered.frequency_Hz =
      frequency_towards_Hz(scan, steered.azimuth_rad).value_or(sensor.waveform.frequency_Hz);
  steered.wavelength_m = core::kSpeedOfLight_mps / steered.frequency_Hz;
  steered.rate_rad_per_Hz = steering_rate_rad_per_Hz(scan, steered.azimuth_rad);
  const double cosine = std::cos(steered.azimuth_rad);
  const double ratio = cosine * steered.frequency_Hz / sensor.waveform.frequency_Hz;
  steered.point_power_ratio = ratio * ratio;
  return steered;
}

double neglected_steering_dB(const Sensor& sensor) {
  double most_dB = 0.0;
  if (!sensor.scan.frequency_scan) return most_dB;
  for (int column = 0; column < sensor.scan.columns; ++column)
    most_dB = std::max(
        most_dB, std::abs(10.0 * std::log10(steered_column(sensor, column).point_power_ratio)));
  return most_dB;
}

}  // namespace fanbeam::sensors
