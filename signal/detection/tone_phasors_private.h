// The weighted phasors that a tone is sought with.
#pragma once

#include <complex>
#include <numeric>
#include <vector>

#include "core/constants.h"

namespace fanbeam::signal {

// Of a tone from sample 0 to the middle, (count - 1) / 2.
inline double middle_turns(std::size_t count, double bin) {
  return 0.5 * bin * static_cast<double>(count - 1) / static_cast<double>(count);
}

// w[n] exp(-j 2 pi bin (n - middle) / count): time from the middle keeps derivatives by the bin
// free of the phase's steep part. No weights: all 1.
inline std::vector<std::complex<double>> tone_phasors(std::size_t count, double bin,
                                                      const std::vector<double>& weights) {
  std::vector<std::complex<double>> phasors(count);
  const double middle = 0.5 * static_cast<double>(count - 1);
  const double per_sample_rad = -2.0 * core::kPi * bin / static_cast<double>(count);
  for (std::size_t n = 0; n < count; ++n)
    phasors[n] = std::polar(weights.empty() ? 1.0 : weights[n],
                            per_sample_rad * (static_cast<double>(n) - middle));
  return phasors;
}

// Of `count` weights, none standing for 1 each.
inline double sum_of_weights(std::size_t count, const std::vector<double>& weights) {
  return weights.empty() ? static_cast<double>(count)
                         : std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace fanbeam::signal
