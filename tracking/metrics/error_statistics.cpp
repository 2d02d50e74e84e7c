#include "tracking/metrics/error_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace fanbeam::tracking {

void MeanSquare::add(double error) {
  if (!std::isfinite(error))
    core::throw_input_error(core::ErrorClass::nonfinite, "error", error, "finite");
  ++count_;
  sum_ += error;
  squares_ += error * error;
  largest_ = std::max(largest_, std::abs(error));
}

void MeanSquare::add(const MeanSquare& others) {
  count_ += others.count_;
  sum_ += others.sum_;
  squares_ += others.squares_;
  largest_ = std::max(largest_, others.largest_);
}

double MeanSquare::rms() const { return count_ == 0 ? 0.0 : std::sqrt(squares_ / count_); }

double MeanSquare::mean() const { return count_ == 0 ? 0.0 : sum_ / count_; }

}  // namespace fanbeam::tracking
