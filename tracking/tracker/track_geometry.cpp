#include "tracking/tracker/track_geometry.h"

#include <cmath>

#include "core/constants.h"
#include "signal/waveform/doppler.h"

namespace fanbeam::tracking {

PolarPlace polar(const ImmState& state) {
  StateVector mean{};
  for (std::size_t model = 0; model < state.states.size(); ++model)
    for (std::size_t i = 0; i < 2 * static_cast<std::size_t>(state.axes); ++i)
      mean[i] += state.probabilities[model] * state.states[model].mean[i];
  if (state.axes == 1) return {mean[0], mean[1], 0.0};
  const double x = mean[0], y = mean[1], range = std::hypot(x, y);
  const double rate = range > 0.0 ? (x * mean[2] + y * mean[3]) / range : 0.0;
  return {range, rate, std::atan2(y, x)};
}

PolarPlace polar(const RadarMeasurement& measurement) {
  return {measurement.range_m, measurement.range_rate_mps, measurement.azimuth_rad};
}

bool unresolved(const PolarPlace& a, const PolarPlace& b, const Resolution& resolution) {
  return std::abs(a.range_m - b.range_m) < resolution.range_m &&
         std::abs(a.range_rate_mps - b.range_rate_mps) < resolution.range_rate_mps &&
         std::abs(signal::fold(a.azimuth_rad - b.azimuth_rad, core::kPi)) < resolution.azimuth_rad;
}

bool between(const PolarPlace& place, const PolarPlace& a, const PolarPlace& b,
             const Resolution& resolution) {
  const auto within = [](double value, double one, double other, double beyond) {
    return value > std::min(one, other) - beyond && value < std::max(one, other) + beyond;
  };
  const double to_b_rad = signal::fold(b.azimuth_rad - a.azimuth_rad, core::kPi);
  const double to_place_rad = signal::fold(place.azimuth_rad - a.azimuth_rad, core::kPi);
  return within(place.range_m, a.range_m, b.range_m, resolution.range_m) &&
         within(place.range_rate_mps, a.range_rate_mps, b.range_rate_mps,
                resolution.range_rate_mps) &&
         within(to_place_rad, 0.0, to_b_rad, resolution.azimuth_rad);
}

Gaussian start_state(const RadarMeasurement& measurement, int axes, double tangential_sigma_mps) {
  Gaussian state;
  const double along[] = {measurement.range_sigma_m, measurement.range_rate_sigma_mps};
  if (axes == 1) {
    state.size = 2;
    state.mean = {measurement.range_m, measurement.range_rate_mps};
    observe(state, 1, Measured::range_and_rate, measurement);
    for (int k = 0; k < 2; ++k) state.variance(k, k) = along[k] * along[k];
    return state;
  }
  state.size = 4;
  const double c = std::cos(measurement.azimuth_rad), s = std::sin(measurement.azimuth_rad);
  state.mean = {measurement.range_m * c, measurement.range_m * s, measurement.range_rate_mps * c,
                measurement.range_rate_mps * s};
  observe(state, 2, Measured::range_rate_and_azimuth, measurement);
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

QuickGate::QuickGate(const ImmState& state, Measured measured, double gate)
    : gate_(gate), axes_(measured == Measured::range ? 1 : 2) {
  for (const Gaussian& model : state.states) {
    // A measurement of zeros and without noise leaves the prediction and its curvature.
    const Observation one = observe(model, state.axes, measured, {});
    Expected expected{};
    for (std::size_t i = 0; i < axes_; ++i) {
      expected.value[i] = -one.residual[i];
      expected.variance[i] = one.noise[i];
      for (int row = 0; row < model.size; ++row)
        for (int column = 0; column < model.size; ++column)
          expected.variance[i] += one.jacobian[i * kMostStates + static_cast<std::size_t>(row)] *
                                  model.variance(row, column) *
                                  one.jacobian[i * kMostStates + static_cast<std::size_t>(column)];
    }
    models_.push_back(expected);
  }
}

bool QuickGate::may_hold(const RadarMeasurement& measurement) const {
  const double value[] = {measurement.range_m, measurement.range_rate_mps};
  const double sigma[] = {measurement.range_sigma_m, measurement.range_rate_sigma_mps};
  // Rounding must not refuse what lies on the border.
  constexpr double kMargin = 1.0 + 1e-9;
  for (const Expected& expected : models_) {
    bool inside = true;
    for (std::size_t i = 0; i < axes_; ++i) {
      const double apart = value[i] - expected.value[i];
      inside =
          inside && apart * apart <= kMargin * gate_ * (expected.variance[i] + sigma[i] * sigma[i]);
    }
    if (inside) return true;
  }
  return false;
}

ImmState moments(const std::vector<WeightedImm>& parts) {
  if (parts.size() == 1) return parts.front().state;
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
