// Root mean square errors, and whether a filter's own uncertainty is honest.
//
//   RMSE = sqrt(sum e^2 / n),   ANEES = sum (x - truth)^T P^-1 (x - truth) / n
// An honest filter of k states has a mean NEES of k; the interval for n independent values is
// mean_interval(k, n) of tracking/filters/chi_square.h.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 5.4.
#pragma once

namespace fanbeam::tracking {

// Finite values; E-NONFINITE otherwise. Empty: 0.
class MeanSquare {
 public:
  void add(double error);
  void add(const MeanSquare& others);
  int count() const { return count_; }
  double rms() const;
  double mean() const;
  double largest() const { return largest_; }  // in amount

 private:
  int count_ = 0;
  double sum_ = 0.0, squares_ = 0.0, largest_ = 0.0;
};

}  // namespace fanbeam::tracking
