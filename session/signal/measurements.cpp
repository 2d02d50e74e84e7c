#include "session/signal/measurements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/constants.h"
#include "signal/fourier/window_figures.h"
#include "signal/waveform/doppler.h"

namespace fanbeam::session {
namespace {

using tracking::RadarMeasurement;

constexpr double kLeastSnr = 1.0;
constexpr double kNoAzimuth_rad = 1.0;

signal::WindowFigures figures_of(const signal::Window& window, int length) {
  const std::vector<double> weights = signal::window_weights(window, length);
  if (weights.size() < 3) return {.half_power_width_bins = 1.0, .variance_ratio = 1.0};
  return signal::window_figures(weights);
}

// Sum of squares of the virtual elements' places to the right about their mean, m2: pitch^2 N (N^2 - 1) / 12
// for N on a line.
double spread_of(const signal::Array& array) {
  const std::vector<glm::dvec3> elements_m = signal::virtual_elements_m(array);
  double mean_m = 0.0, sum_m2 = 0.0;
  for (const glm::dvec3& element : elements_m)
    mean_m += element.y / static_cast<double>(elements_m.size());
  for (const glm::dvec3& element : elements_m) sum_m2 += std::pow(element.y - mean_m, 2);
  return sum_m2;
}

// Errors of one cell's width by the windows of a radar.
class Noise {
 public:
  explicit Noise(const FmcwRadar& radar) : radar_(radar) {
    const auto& transform = radar.detection.transform;
    const int samples = signal::samples_per_segment(radar.waveform, 0);
    range_ = std::sqrt(figures_of(transform.range_window, samples).variance_ratio);
    speed_ =
        std::sqrt(figures_of(transform.doppler_window, radar.axes.doppler_cells).variance_ratio);
    spread_m_ = std::sqrt(spread_of(radar.array));
  }

  void put(double snr, RadarMeasurement& measurement) const {
    const double ratio = std::max(snr, kLeastSnr);
    const double bin = std::sqrt(6.0 / (ratio * radar_.array.channels())) / (2.0 * core::kPi);
    const signal::RangeDopplerAxes& axes = radar_.axes;
    measurement.range_sigma_m = bin * range_ * axes.range_step_m;
    measurement.range_rate_sigma_mps = bin * speed_ * (axes.speed_mps(1.0) - axes.speed_mps(0.0));
    // Towards the end of a line the bound grows without end; one element tells no azimuth.
    const double across = std::max(0.05, std::cos(measurement.azimuth_rad));
    const double turns = spread_m_ / radar_.waveform.wavelength_m();
    measurement.azimuth_sigma_rad =
        std::min(kNoAzimuth_rad, 1.0 / (2.0 * core::kPi * turns * across * std::sqrt(2.0 * ratio)));
  }

 private:
  const FmcwRadar& radar_;
  double range_ = 1.0, speed_ = 1.0, spread_m_ = 0.0;
};

RadarMeasurement of_one(const signal::RadarDetection& detection, const BodyErrors& errors) {
  RadarMeasurement measurement;
  measurement.range_m = detection.range_m;
  measurement.range_rate_mps = detection.radial_speed_mps;
  measurement.azimuth_rad = detection.azimuth_rad;
  measurement.range_systematic_m = errors.range_m;
  measurement.range_rate_systematic_mps = errors.range_rate_mps;
  measurement.azimuth_systematic_rad = errors.azimuth_rad;
  return measurement;
}

bool is_object(const std::vector<signal::RadarDetection>& parts) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double back_m = kFar, front_m = -kFar, left_m = kFar, right_m = -kFar;
  for (const signal::RadarDetection& part : parts) {
    const double x_m = part.range_m * std::cos(part.azimuth_rad);
    const double y_m = part.range_m * std::sin(part.azimuth_rad);
    back_m = std::min(back_m, x_m);
    front_m = std::max(front_m, x_m);
    left_m = std::min(left_m, y_m);
    right_m = std::max(right_m, y_m);
  }
  return std::hypot(front_m - back_m, right_m - left_m) <= kLongestObject_m;
}

RadarMeasurement of_object(const std::vector<signal::RadarDetection>& parts,
                           const BodyErrors& errors) {
  double sum = 0.0;
  for (const signal::RadarDetection& part : parts) sum += part.power_W;
  const auto weight = [&](const signal::RadarDetection& part) {
    return sum > 0.0 ? part.power_W / sum : 1.0 / static_cast<double>(parts.size());
  };
  // Half a turn left is half a turn right: azimuths count from one of them.
  const auto turned_rad = [](double azimuth_rad, double from_rad) {
    return signal::fold(azimuth_rad - from_rad, core::kPi);
  };
  const double first_rad = parts.front().azimuth_rad;
  RadarMeasurement mean = of_one(parts.front(), errors);
  mean.range_m = mean.range_rate_mps = 0.0;
  double mean_turned_rad = 0.0;
  for (const signal::RadarDetection& part : parts) {
    mean.range_m += weight(part) * part.range_m;
    mean.range_rate_mps += weight(part) * part.radial_speed_mps;
    mean_turned_rad += weight(part) * turned_rad(part.azimuth_rad, first_rad);
  }
  mean.azimuth_rad = signal::fold(first_rad + mean_turned_rad, core::kPi);
  double range = 0.0, rate = 0.0, azimuth = 0.0;
  for (const signal::RadarDetection& part : parts) {
    range += weight(part) * std::pow(part.range_m - mean.range_m, 2);
    rate += weight(part) * std::pow(part.radial_speed_mps - mean.range_rate_mps, 2);
    azimuth += weight(part) * std::pow(turned_rad(part.azimuth_rad, mean.azimuth_rad), 2);
  }
  mean.range_systematic_m = std::hypot(errors.range_m, std::sqrt(range));
  mean.range_rate_systematic_mps = std::hypot(errors.range_rate_mps, std::sqrt(rate));
  mean.azimuth_systematic_rad = std::hypot(errors.azimuth_rad, std::sqrt(azimuth));
  return mean;
}

}  // namespace

std::vector<RadarMeasurement> measurements_of(const DetectedFrame& frame, const FmcwRadar* radar,
                                              const BodyErrors& errors) {
  std::map<int, std::vector<signal::RadarDetection>> clusters;
  std::vector<RadarMeasurement> result;
  std::vector<double> ratios;
  const auto put = [&](const RadarMeasurement& measurement, double snr) {
    result.push_back(measurement);
    ratios.push_back(snr);
  };
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (frame.clusters[i] == signal::kNoCluster)
      put(of_one(frame.detections[i], errors), frame.detections[i].snr);
    else
      clusters[frame.clusters[i]].push_back(frame.detections[i]);
  }
  for (const auto& [number, parts] : clusters) {
    if (is_object(parts)) {
      double snr = 0.0;
      for (const signal::RadarDetection& part : parts) snr = std::max(snr, part.snr);
      put(of_object(parts, errors), snr);
      continue;
    }
    for (const signal::RadarDetection& part : parts) put(of_one(part, errors), part.snr);
  }
  if (radar != nullptr) {
    const Noise noise(*radar);
    for (std::size_t i = 0; i < result.size(); ++i) noise.put(ratios[i], result[i]);
  }
  return result;
}

tracking::Resolution resolution_of(const FmcwRadar& radar) {
  const auto& transform = radar.detection.transform;
  const int samples = signal::samples_per_segment(radar.waveform, 0);
  const signal::RangeDopplerAxes& axes = radar.axes;
  tracking::Resolution resolution;
  resolution.range_m =
      axes.range_step_m * figures_of(transform.range_window, samples).half_power_width_bins;
  resolution.range_rate_mps =
      (axes.speed_mps(1.0) - axes.speed_mps(0.0)) *
      figures_of(transform.doppler_window, axes.doppler_cells).half_power_width_bins;
  // The line of as many elements and the same spread: its length is pitch * N.
  constexpr double kBeamwidth = 0.8859;
  const double n = radar.array.channels();
  const double length_m =
      n > 1.0 ? std::sqrt(12.0 * spread_of(radar.array) * n / (n * n - 1.0)) : 0.0;
  resolution.azimuth_rad =
      std::min(kNoAzimuth_rad, kBeamwidth * radar.waveform.wavelength_m() / length_m);
  return resolution;
}

}  // namespace fanbeam::session
