#include "tracking/association/crossing.h"

#include <cmath>

#include "core/errors.h"

namespace fanbeam::tracking {

double normal_tail(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

double swap_probability(double speed_difference_mps, double speed_sigma_mps) {
  if (!(speed_sigma_mps > 0.0) || !std::isfinite(speed_difference_mps))
    core::throw_input_error(core::ErrorClass::range, "speed_sigma_mps", speed_sigma_mps,
                            "above 0, with a finite difference");
  const double p = normal_tail(std::abs(speed_difference_mps) / (std::sqrt(2.0) * speed_sigma_mps));
  return 2.0 * p * (1.0 - p);
}

double kept_by_speed(double before_mps, double before_variance, double after_mps,
                     double after_variance) {
  if (!(before_variance > 0.0) || !(after_variance > 0.0) || !std::isfinite(before_mps) ||
      !std::isfinite(after_mps))
    core::throw_input_error(core::ErrorClass::range, "variance", before_variance,
                            "above 0, with finite differences");
  const double amount_mps = std::sqrt(
      (before_mps * before_mps / before_variance + after_mps * after_mps / after_variance) /
      (1.0 / before_variance + 1.0 / after_variance));
  const auto positive = [&](double difference_mps, double variance) {
    return 1.0 / (1.0 + std::exp(-2.0 * difference_mps * amount_mps / variance));
  };
  const double before = positive(before_mps, before_variance);
  const double after = positive(after_mps, after_variance);
  return before * after + (1.0 - before) * (1.0 - after);
}

double kept_probability(double log_likelihood_kept, double log_likelihood_swapped,
                        double prior_kept) {
  if (!(prior_kept >= 0.0 && prior_kept <= 1.0))
    core::throw_input_error(core::ErrorClass::range, "prior_kept", prior_kept, "0 to 1");
  const double difference = log_likelihood_kept - log_likelihood_swapped;
  if (std::isnan(difference) || prior_kept == 0.0 || prior_kept == 1.0) return prior_kept;
  return 1.0 / (1.0 + (1.0 - prior_kept) / prior_kept * std::exp(-difference));
}

double kept_probability(const ImmState& a, const ImmState& b, Measured measured,
                        const RadarMeasurement& c, const RadarMeasurement& d, double prior_kept) {
  const auto fit = [&](const ImmState& track, const RadarMeasurement& seen) {
    const Update told = innovation(track, measured, seen);
    return told.applied ? told.log_likelihood : -HUGE_VAL;
  };
  return kept_probability(fit(a, c) + fit(b, d), fit(a, d) + fit(b, c), prior_kept);
}

}  // namespace fanbeam::tracking
