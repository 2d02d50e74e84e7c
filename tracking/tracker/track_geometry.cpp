#include "tracking/tracker/track_geometry.h"

#include <cmath>

#include "core/constants.h"
#include "signal/waveform/doppler.h"
#include "tracking/tracker/tracker.h"

namespace fanbeam::tracking {

PolarPlace polar(const ImmState& state) {
  const Gaussian place = combined(state);
  const double x = place.mean[0], y = place.mean[1], range = std::hypot(x, y);
  const double rate = range > 0.0 ? (x * place.mean[2] + y * place.mean[3]) / range : 0.0;
  return {range, rate, std::atan2(y, x)};
}

PolarPlace polar(const RadarMeasurement& measurement) {
  return {measurement.range_m, measurement.range_rate_mps, measurement.azimuth_rad};
}

bool unresolved(const PolarPlace& a, const PolarPlace& b, const TrackerSettings& settings) {
  return std::abs(a.range_m - b.range_m) < settings.resolution_m &&
         std::abs(a.range_rate_mps - b.range_rate_mps) < settings.resolution_mps &&
         std::abs(signal::fold(a.azimuth_rad - b.azimuth_rad, core::kPi)) < settings.resolution_rad;
}

Gaussian start_state(const RadarMeasurement& measurement, double tangential_sigma_mps) {
  Gaussian state;
  state.size = 4;
  const double c = std::cos(measurement.azimuth_rad), s = std::sin(measurement.azimuth_rad);
  state.mean = {measurement.range_m * c, measurement.range_m * s, measurement.range_rate_mps * c,
                measurement.range_rate_mps * s};
  observe(state, 2, Measured::range_rate_and_azimuth, measurement);
  const double along[] = {measurement.range_sigma_m, measurement.range_rate_sigma_mps};
  const double across[] = {measurement.range_m * measurement.azimuth_sigma_rad,
                           tangential_sigma_mps};
  for (int k = 0; k < 2; ++k) {
    const double a = along[k] * along[k], b = across[k] * across[k];
    state.variance(2 * k, 2 * k) = c * c * a + s * s * b;
    state.variance(2 * k + 1, 2 * k + 1) = s * s * a + c * c * b;
    state.variance(2 * k, 2 * k + 1) = state.variance(2 * k + 1, 2 * k) = s * c * (a - b);
  }
  return state;
}

ImmState moments(const std::vector<WeightedImm>& parts) {
  ImmState result = parts.front().state;
  double all = 0.0;
  for (std::size_t model = 0; model < result.states.size(); ++model) {
    std::vector<WeightedGaussian> mixture;
    double total = 0.0;
    for (const WeightedImm& part : parts) {
      const double weight = part.weight * part.state.probabilities[model];
      mixture.push_back({weight, part.state.states[model]});
      total += weight;
    }
    if (total > 0.0) result.states[model] = moments(mixture);
    result.probabilities[model] = total;
    all += total;
  }
  for (double& probability : result.probabilities) probability /= all;
  return result;
}

}  // namespace fanbeam::tracking
