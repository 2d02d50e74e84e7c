#include "tracking/filters/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

// In double throughout, as everything else.
using Law = boost::math::chi_squared_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

}  // namespace

double chi_square_quantile(double probability, double degrees) {
  if (!(probability > 0.0 && probability < 1.0))
    core::throw_input_error(core::ErrorClass::range, "chi_square.probability", probability,
                            "between 0 and 1");
  return quantile(Law(degrees), probability);
}

Interval mean_interval(int degrees, int runs, double confidence) {
  if (degrees < 1 || runs < 1)
    core::throw_input_error(core::ErrorClass::range, "mean_interval.runs", runs, "1 or more");
  const double all = static_cast<double>(degrees) * runs, tail = 0.5 * (1.0 - confidence);
  return {chi_square_quantile(tail, all) / runs, chi_square_quantile(1.0 - tail, all) / runs};
}

}  // namespace fanbeam::tracking
