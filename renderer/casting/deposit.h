// Spreading a ray's power over range cells and elevation rows.
#pragma once

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

// Adds `amount`, spread evenly over [from, to] in units of bins, to bins [0, count). What lies
// outside is not deposited; a zero width goes to one bin; borders are half open. The shares inside
// add up to `amount` within rounding because each is cut from the same running remainder.
inline void deposit(double from, double to, double amount, double* bins, int count) noexcept {
  if (from >= count || to < 0.0 || (to == 0.0 && from < 0.0)) return;
  const int first = static_cast<int>(std::floor(from));
  const int last = static_cast<int>(std::floor(to));
  if (first == last) {
    if (first >= 0) bins[first] += amount;
    return;
  }
  const double per_bin = amount / (to - from);
  double left = amount;
  if (first >= 0) {
    const double share = (first + 1 - from) * per_bin;
    bins[first] += share;
    left -= share;
  } else {
    left -= -from * per_bin;
  }
  const int stop = std::min(last, count);
  for (int bin = std::max(first + 1, 0); bin < stop; ++bin) {
    bins[bin] += per_bin;
    left -= per_bin;
  }
  if (last < count && last >= 0) bins[last] += std::max(left, 0.0);
}

// The same where the density rises or falls evenly on the way: 1 - tilt at `from`, 1 + tilt at `to`,
// |tilt| <= 1.
inline void deposit_tilted(double from, double to, double amount, double tilt, double* bins,
                           int count) noexcept {
  if (from >= count || to < 0.0 || (to == 0.0 && from < 0.0)) return;
  const int first = static_cast<int>(std::floor(from));
  const int last = static_cast<int>(std::floor(to));
  const double per_width = first < last ? 1.0 / (to - from) : 0.0;
  const auto amount_before = [&](double place) {
    const double way = (place - from) * per_width;
    return amount * way * (1.0 + tilt * (way - 1.0));
  };
  double before = first < 0 ? amount_before(0.0) : 0.0;
  const int stop = std::min(last, count);
  for (int bin = std::max(first, 0); bin < stop; ++bin) {
    const double until = amount_before(bin + 1);
    bins[bin] += std::max(until - before, 0.0);
    before = until;
  }
  if (last < count && last >= 0) bins[last] += std::max(amount - before, 0.0);
}

}  // namespace fanbeam::renderer
