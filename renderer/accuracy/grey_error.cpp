#include "renderer/accuracy/grey_error.h"

#include <algorithm>
#include <cmath>

#include "sensors/display/display.h"

namespace fanbeam::renderer {
namespace {

std::vector<double> plus(std::vector<double> values, double constant) {
  for (double& value : values) value += constant;
  return values;
}

double root_mean(double sum, std::size_t count) {
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

GreyError compare(const std::vector<double>& grey, const std::vector<double>& reference,
                  const std::vector<double>& noise_free_reference) {
  double sum = 0.0;
  double lit_sum = 0.0;
  std::vector<double> lit;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const double difference = std::abs(grey[i] - reference[i]);
    sum += difference * difference;
    if (!(noise_free_reference[i] > 0.0)) continue;
    lit_sum += difference * difference;
    lit.push_back(difference);
  }
  GreyError error{root_mean(sum, grey.size()), root_mean(lit_sum, lit.size()), 0.0};
  if (lit.empty()) return error;
  const auto p99 = lit.begin() + static_cast<std::ptrdiff_t>((lit.size() - 1) * 99 / 100);
  std::nth_element(lit.begin(), p99, lit.end());
  error.lit_p99 = *p99;
  return error;
}

}  // namespace

FrameGrey grey_of(const sensors::Sensor& sensor, const FramePower& power, bool noise) {
  if (!noise)
    return {sensors::bscope_grey(sensor, power.bscope_W),
            sensors::cscope_grey(sensor, power.cscope_W_m3)};
  const bool own_noise = sensor.display.cscope_mode == sensors::Display::CScopeMode::true_elevation;
  return {sensors::bscope_grey(sensor, plus(power.bscope_W, sensor.noise_power_W())),
          sensors::cscope_grey(sensor, plus(power.cscope_W_m3,
                                            own_noise ? sensors::cscope_noise_W_m3(sensor) : 0.0))};
}

GreyReference::GreyReference(const sensors::Sensor& sensor, const FramePower& power)
    : sensor_(sensor),
      with_noise_(grey_of(sensor, power, true)),
      noise_free_(grey_of(sensor, power, false)) {}

FrameError GreyReference::error_of(const FramePower& power) const {
  const FrameGrey with_noise = grey_of(sensor_, power, true);
  const FrameGrey noise_free = grey_of(sensor_, power, false);
  return {{compare(with_noise.bscope, with_noise_.bscope, noise_free_.bscope),
           compare(noise_free.bscope, noise_free_.bscope, noise_free_.bscope)},
          {compare(with_noise.cscope, with_noise_.cscope, noise_free_.cscope),
           compare(noise_free.cscope, noise_free_.cscope, noise_free_.cscope)}};
}

}  // namespace fanbeam::renderer
