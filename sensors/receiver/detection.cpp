#include "sensors/receiver/detection.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::sensors {
namespace {

namespace math = boost::math;

// In double throughout, as everything else.
using InDouble = math::policies::policy<math::policies::promote_double<false>>;

constexpr int kMostLooks = 1000;
constexpr double kLargestSnr = 1e15;

void check_looks(int looks) { core::require_range("looks", looks, {1.0, kMostLooks}); }

void check_probability(const char* field, double value, double above = 0.0) {
  if (!(value > above && value < 1.0))
    core::throw_input_error(
        std::isfinite(value) ? core::ErrorClass::range : core::ErrorClass::nonfinite, field, value,
        "above " + core::number_text(above) + " and below 1");
}

// Order of the gamma law of the summed signal power; 0 stands for a steady target.
int gamma_order(core::Swerling target, int looks) {
  switch (target) {
    case core::Swerling::case1:
      return 1;
    case core::Swerling::case2:
      return looks;
    case core::Swerling::case3:
      return 2;
    case core::Swerling::case4:
      return 2 * looks;
    default:
      return 0;
  }
}

// e^-x x^k / k!
double poisson_probability(int k, double x) {
  return math::gamma_p_derivative(k + 1.0, x, InDouble());
}

// w_k of the header, for a summed signal-to-noise ratio above 0.
double weight(int order, int k, double sum_snr) {
  if (order == 0) return poisson_probability(k, sum_snr);
  return std::exp(std::lgamma(static_cast<double>(order + k)) - std::lgamma(k + 1.0) -
                  std::lgamma(static_cast<double>(order)) - order * std::log1p(sum_snr / order) -
                  k * std::log1p(order / sum_snr));
}

}  // namespace

double detection_threshold(double false_alarm_probability, int looks) {
  check_probability("false-alarm probability", false_alarm_probability);
  check_looks(looks);
  return math::gamma_q_inv(static_cast<double>(looks), false_alarm_probability, InDouble());
}

double detection_probability(core::Swerling target, double snr, int looks, double threshold) {
  check_looks(looks);
  core::require_range("signal-to-noise ratio", snr, {.low = 0.0});
  core::require_range("threshold", threshold, {.low = 0.0});
  double exceeded =  // Q(N + k, T)
      threshold > 0.0 ? math::gamma_q(static_cast<double>(looks), threshold, InDouble()) : 1.0;
  const double sum_snr = looks * snr;
  if (!(sum_snr > 0.0)) return exceeded;
  const int order = gamma_order(target, looks);
  // From here on Q(N + k, T) is 1 to the last bit: the Poisson law of mean T ends before.
  const double end = threshold + 12.0 * std::sqrt(threshold) + 60.0;
  double probability = 0.0;
  double weights = 0.0;
  for (int k = 0; looks + k <= end; ++k) {
    const double w = weight(order, k, sum_snr);
    weights += w;
    probability += w * std::min(exceeded, 1.0);
    exceeded += poisson_probability(looks + k, threshold);
  }
  return std::clamp(probability + std::max(0.0, 1.0 - weights), 0.0, 1.0);
}

double required_snr(core::Swerling target, double probability, double false_alarm_probability,
                    int looks) {
  const double threshold = detection_threshold(false_alarm_probability, looks);
  check_probability("detection probability", probability, false_alarm_probability);
  double low = 0.0;
  double high = 1.0;
  while (detection_probability(target, high, looks, threshold) < probability) {
    low = high;
    high *= 2.0;
    if (high > kLargestSnr)
      core::throw_input_error(core::ErrorClass::range, "detection probability", probability,
                              "one that a finite signal reaches");
  }
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (detection_probability(target, middle, looks, threshold) < probability ? low : high) = middle;
  }
}

}  // namespace fanbeam::sensors
