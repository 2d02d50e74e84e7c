// The chi-square law: gates of measurements and intervals of consistency tests.
//
// P(X <= x) = P(k/2, x/2), the regularised incomplete gamma function (Boost.Math). The mean of
// n values of k degrees lies in [q(0.025), q(0.975)] of n k degrees, divided by n, in 95 of 100
// cases (Y. Bar-Shalom et al., "Estimation with Applications to Tracking and Navigation", 2001, 5.4).
// Accuracy: 1e-12 in probability up to 1e4 degrees.
#pragma once

namespace fanbeam::tracking {

// The x below which a value lies with that probability, in (0, 1); E-RANGE otherwise.
double chi_square_quantile(double probability, double degrees);

struct Interval {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return low <= value && value <= high; }
};

// Two-sided, of the mean of `runs` values of `degrees` degrees each.
Interval mean_interval(int degrees, int runs, double confidence = 0.95);

}  // namespace fanbeam::tracking
