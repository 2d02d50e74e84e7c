#include "tracking/tracker/existence.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::tracking {
namespace {

constexpr double kHidesPerSecond = 0.1;
constexpr double kGonePerBelieved = 0.4456;  // e^-x (2 x - 1) = x - 1, less 1

}  // namespace

void Existence::pass(double step_s, double believed_s) {
  const double hides = seen * -std::expm1(-kHidesPerSecond * step_s);
  const double still = hidden * std::exp(-kGonePerBelieved * step_s / believed_s);
  const double returns = still * -std::expm1(-step_s / believed_s);
  seen = std::min(seen + returns - hides, 1.0);  // but for rounding
  hidden = still + hides - returns;
}

void Existence::missed(double probability) {
  const double silent = seen * (1.0 - probability), all = 1.0 - seen * probability;
  if (!(all > 0.0)) return;
  seen = silent / all;
  hidden /= all;
}

void Existence::measured(double log_ratio) {
  if (!(seen > 0.0)) return;
  const double others = (1.0 - seen) * std::exp(-log_ratio) / seen;
  const double share = 1.0 / (1.0 + others);  // of what is seen
  hidden = seen < 1.0 ? hidden / (1.0 - seen) * (1.0 - share) : 0.0;
  seen = share;
}

void Existence::associated(double seen_after, double none_measured, double probability) {
  const double all = 1.0 - seen * probability;
  hidden = all > 0.0 ? hidden * none_measured / all : 0.0;
  seen = seen_after;
}

}  // namespace fanbeam::tracking
