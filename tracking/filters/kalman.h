// Kalman update of a state by a linearised measurement, in Joseph's form.
//
//   S = H P H^T + R,  K = P H^T S^-1,  x += K (z - h(x)),
//   P = (I - K H) P (I - K H)^T + K R K^T
// With a linear h this is the linear filter, with the Jacobian of observation.h the extended one.
// The short form (I - K H) P gives 0 where a superb measurement meets a poor prior, and loses
// symmetry and definiteness in long runs; Joseph's form is a sum of squares and keeps both.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 5.2 and 10.3; R. S. Bucy, P. D. Joseph, 1968.
// An innovation covariance that cannot be inverted (a variance at or below the rounding of the
// measured value, or a correlation of 1 to 1e-12) leaves the state as it is: `applied` is false, to
// be counted. Cost: about 1 us for six states.
#pragma once

#include "tracking/filters/observation.h"

namespace fanbeam::tracking {

struct Update {
  bool applied = false;
  double normalised_innovation_squared = 0.0;  // nu^T S^-1 nu, chi-square of the dimension
  double log_likelihood = 0.0;                 // of nu under N(0, S)
  StateMatrix gain{};                          // K, `size` columns
};

// What the update would tell, without changing the state.
Update innovation(const Gaussian& state, const Observation& observation);
Update update(Gaussian& state, const Observation& observation);

}  // namespace fanbeam::tracking
