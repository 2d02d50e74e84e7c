#include "tracking/filters/observation.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/waveform/doppler.h"
#include "tracking/filters/matrices_private.h"

namespace fanbeam::tracking {
namespace {

constexpr double kLeastRange_m = 1e-3;

void check(const RadarMeasurement& m, int size) {
  const double values[] = {m.range_m, m.range_rate_mps, m.azimuth_rad};
  const double sigmas[][2] = {{m.range_sigma_m, m.range_systematic_m},
                              {m.range_rate_sigma_mps, m.range_rate_systematic_mps},
                              {m.azimuth_sigma_rad, m.azimuth_systematic_rad}};
  constexpr const char* kNames[] = {"measurement.range_m", "measurement.range_rate_mps",
                                    "measurement.azimuth_rad"};
  constexpr const char* kSigmaNames[] = {"measurement.range_sigma_m",
                                         "measurement.range_rate_sigma_mps",
                                         "measurement.azimuth_sigma_rad"};
  for (int i = 0; i < size; ++i) {
    if (!std::isfinite(values[i]))
      core::throw_input_error(core::ErrorClass::nonfinite, kNames[i], values[i], "a finite value");
    for (const double sigma : sigmas[i]) {
      if (!std::isfinite(sigma))
        core::throw_input_error(core::ErrorClass::nonfinite, kSigmaNames[i], sigma,
                                "a finite value");
      if (sigma < 0.0)
        core::throw_input_error(core::ErrorClass::range, kSigmaNames[i], sigma, "0 or more");
    }
  }
}

// Terms of second order in what lies across the line of sight: p in position, v in velocity.
void add_curvature(const Gaussian& state, Observation& observation,
                   std::array<double, kMostMeasured>& predicted) {
  const double range = predicted[0];
  const double tx = -observation.jacobian[1], ty = observation.jacobian[0];
  const auto across = [&](int row, int column) {
    return tx * tx * state.variance(row, column) + ty * ty * state.variance(row + 1, column + 1) +
           tx * ty * (state.variance(row, column + 1) + state.variance(row + 1, column));
  };
  const double pp = across(0, 0), pv = across(0, 2), vv = across(2, 2);
  predicted[0] += 0.5 * pp / range;
  predicted[1] += pv / range;
  observation.noise[0] += 0.5 * pp * pp / (range * range);
  observation.noise[1] += std::max(0.0, pp * vv + pv * pv) / (range * range);
}

}  // namespace

int dimension(Measured measured) {
  return measured == Measured::range ? 1 : measured == Measured::range_and_rate ? 2 : 3;
}

Observation observe(const Gaussian& state, int axes, Measured measured,
                    const RadarMeasurement& measurement) {
  Observation result;
  result.size = dimension(measured);
  check(measurement, result.size);
  result.value = {measurement.range_m, measurement.range_rate_mps, measurement.azimuth_rad};
  result.noise = {std::pow(measurement.range_sigma_m, 2),
                  std::pow(measurement.range_rate_sigma_mps, 2),
                  std::pow(measurement.azimuth_sigma_rad, 2)};
  std::array<double, kMostMeasured> predicted{};
  const auto at = [&](int row, int column) -> double& {
    return result.jacobian[static_cast<std::size_t>(row * kMostStates + column)];
  };
  if (axes == 1) {
    if (measured == Measured::range_rate_and_azimuth)
      core::throw_input_error(core::ErrorClass::range, "state.axes", axes, "2, to see an azimuth");
    predicted = {state.mean[0], state.mean[1], 0.0};
    at(0, 0) = at(1, 1) = 1.0;
  } else {
    const double x = state.mean[0], y = state.mean[1], vx = state.mean[2], vy = state.mean[3];
    const double distance = std::hypot(x, y), range = std::max(distance, kLeastRange_m);
    const double ux = distance > 0.0 ? x / distance : 1.0, uy = distance > 0.0 ? y / distance : 0.0;
    const double rate = ux * vx + uy * vy;
    predicted = {range, rate, std::atan2(y, x)};
    at(0, 0) = at(1, 2) = ux;
    at(0, 1) = at(1, 3) = uy;
    at(1, 0) = (vx - rate * ux) / range;
    at(1, 1) = (vy - rate * uy) / range;
    at(2, 0) = -uy / range;
    at(2, 1) = ux / range;
  }
  if (axes == 2) add_curvature(state, result, predicted);
  for (std::size_t i = 0; i < 3; ++i) result.residual[i] = result.value[i] - predicted[i];
  result.residual[2] = signal::fold(result.residual[2], core::kPi);
  return result;
}

}  // namespace fanbeam::tracking
