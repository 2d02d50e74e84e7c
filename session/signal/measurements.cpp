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
constexpr double kNoAngle_rad = 1.0;
constexpr double kLeastCosine = 0.05;
constexpr double kLeastRange_m = 1e-3;  // of what comes out of the antenna

signal::WindowFigures figures_of(const signal::Window& window, int length) {
  const std::vector<double> weights = signal::window_weights(window, length);
  if (weights.size() < 3)
    return {.half_power_width_bins = 1.0, .noise_bandwidth_bins = 1.0, .variance_ratio = 1.0};
  return signal::window_figures(weights);
}

// Deviation of a place under the window, over that of the bound with the signal to noise of a cell.
double over_bound(const signal::WindowFigures& figures) {
  return std::sqrt(figures.variance_ratio / figures.noise_bandwidth_bins);
}

// Sum of squares of the virtual elements' places to the right (1) or up (2) about their mean, m2:
// pitch^2 N (N^2 - 1) / 12 for N on a line.
double spread_of(const signal::Array& array, int axis) {
  const std::vector<glm::dvec3> elements_m = signal::virtual_elements_m(array);
  // Counted from the first, so that the spread of one height, whatever it is, is exactly 0.
  const double first_m = elements_m.front()[axis];
  double mean_m = 0.0, sum_m2 = 0.0;
  for (const glm::dvec3& element : elements_m)
    mean_m += (element[axis] - first_m) / static_cast<double>(elements_m.size());
  for (const glm::dvec3& element : elements_m)
    sum_m2 += std::pow(element[axis] - first_m - mean_m, 2);
  return sum_m2;
}

double least_cosine(double angle_rad) { return std::max(kLeastCosine, std::cos(angle_rad)); }

// Errors of one cell's width by the windows of a radar, and the range at the time of the frame.
class Noise {
 public:
  explicit Noise(const FmcwRadar& radar) : radar_(radar) {
    const auto& transform = radar.detection.transform;
    const int samples = signal::samples_per_segment(radar.waveform, 0);
    range_ = over_bound(figures_of(transform.range_window, samples));
    speed_ = over_bound(figures_of(transform.doppler_window, radar.axes.doppler_cells));
    right_m_ = std::sqrt(spread_of(radar.array, 1));
    up_m_ = std::sqrt(spread_of(radar.array, 2));
  }

  void put(double snr, double elevation_rad, RadarMeasurement& measurement) const {
    const double ratio = std::max(snr, kLeastSnr);
    const double bin = std::sqrt(6.0 / (ratio * radar_.array.channels())) / (2.0 * core::kPi);
    const signal::RangeDopplerAxes& axes = radar_.axes;
    const double level = least_cosine(elevation_rad);
    const double rise = std::abs(std::sin(elevation_rad)) / level;
    const double rise_rad = rise > 0.0 ? rise * angle_rad(up_m_, level, ratio) : 0.0;
    measurement.range_sigma_m =
        std::hypot(bin * range_ * axes.range_step_m * level, measurement.range_m * rise_rad);
    measurement.range_rate_sigma_mps =
        std::hypot(bin * speed_ * (axes.speed_mps(1.0) - axes.speed_mps(0.0)) / level,
                   measurement.range_rate_mps * rise_rad);
    // Towards the end of a line the bound grows without end; one element tells no azimuth.
    measurement.azimuth_sigma_rad =
        angle_rad(right_m_, level * least_cosine(measurement.azimuth_rad), ratio);
    measurement.range_m =
        std::max(kLeastRange_m, measurement.range_m - measurement.range_rate_mps * radar_.middle_s);
  }

 private:
  double angle_rad(double spread_m, double across, double ratio) const {
    const double turns = spread_m / radar_.waveform.wavelength_m();
    return std::min(kNoAngle_rad,
                    1.0 / (2.0 * core::kPi * turns * across * std::sqrt(2.0 * ratio)));
  }

  const FmcwRadar& radar_;
  double range_ = 1.0, speed_ = 1.0, right_m_ = 0.0, up_m_ = 0.0;
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

double on_plane_m(double range_m, double elevation_rad) {
  return std::max(kLeastRange_m, range_m * least_cosine(elevation_rad));
}

double on_plane_mps(double radial_speed_mps, double elevation_rad) {
  return radial_speed_mps / least_cosine(elevation_rad);
}

bool tells_azimuth(const FmcwRadar& radar) { return spread_of(radar.array, 1) > 0.0; }

bool tells_elevation(const FmcwRadar& radar) { return spread_of(radar.array, 2) > 0.0; }

std::vector<RadarMeasurement> measurements_of(const DetectedFrame& frame, const FmcwRadar* radar,
                                              const BodyErrors& errors) {
  std::map<int, std::vector<signal::RadarDetection>> clusters;
  std::vector<RadarMeasurement> result;
  std::vector<signal::RadarDetection> strongest;  // of each
  const auto put = [&](const RadarMeasurement& measurement, const signal::RadarDetection& part) {
    result.push_back(measurement);
    strongest.push_back(part);
  };
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    signal::RadarDetection one = frame.detections[i];
    one.range_m = on_plane_m(one.range_m, one.elevation_rad);
    one.radial_speed_mps = on_plane_mps(one.radial_speed_mps, one.elevation_rad);
    if (frame.clusters[i] == signal::kNoCluster)
      put(of_one(one, errors), one);
    else
      clusters[frame.clusters[i]].push_back(one);
  }
  for (const auto& [number, parts] : clusters) {
    if (is_object(parts)) {
      put(of_object(parts, errors),
          *std::max_element(parts.begin(), parts.end(),
                            [](const auto& a, const auto& b) { return a.snr < b.snr; }));
      continue;
    }
    for (const signal::RadarDetection& part : parts) put(of_one(part, errors), part);
  }
  if (radar != nullptr) {
    const Noise noise(*radar);
    for (std::size_t i = 0; i < result.size(); ++i)
      noise.put(strongest[i].snr, strongest[i].elevation_rad, result[i]);
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
      n > 1.0 ? std::sqrt(12.0 * spread_of(radar.array, 1) * n / (n * n - 1.0)) : 0.0;
  resolution.azimuth_rad =
      std::min(kNoAngle_rad, kBeamwidth * radar.waveform.wavelength_m() / length_m);
  return resolution;
}

}  // namespace fanbeam::session
