// Spreading a ray's power over range cells and elevation rows.
#pragma once

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

// Adds `amount`, spread over [from, to] in units of bins with a density that goes evenly from
// 1 - tilt to 1 + tilt, |tilt| <= 1, to bins [0, count). What lies outside is not deposited; a zero width
// goes to one bin; borders are half open. The shares inside add up to `amount` within rounding because
// each is what lies before its end less what lies before its begin.
inline void deposit(double from, double to, double amount, double* bins, int count,
                    double tilt = 0.0) noexcept {
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
