// The top of a sampled peak from its three highest values, by the parabola through their
// logarithms.
//
//   offset = 1/2 (ln l - ln r) / (ln l - 2 ln c + ln r),  top = c exp(-offset (ln l - ln r) / 4)
//
// Exact for a Gaussian. For a tone under a window it leaves a bias, without padding up to 0.016 bins
// under Hann's and 0.167 under none; it is the start of the maximum-likelihood search in
// signal/detection/tone.h. A neighbour of zero power, or a centre that is no maximum, leaves the
// place at the centre.
#pragma once

#include <cmath>

namespace fanbeam::signal {

struct PeakFit {
  double offset = 0.0;  // in cells from the centre, within -1/2 to 1/2 for a maximum
  double top = 0.0;     // power
};

inline PeakFit log_parabola_peak(double left, double centre, double right) {
  if (!(left > 0.0 && right > 0.0 && centre >= left && centre >= right)) return {0.0, centre};
  const double slope = std::log(left) - std::log(right);
  const double bend = std::log(left) - 2.0 * std::log(centre) + std::log(right);
  if (!(bend < 0.0)) return {0.0, centre};
  const double offset = 0.5 * slope / bend;
  return {offset, centre * std::exp(-0.25 * offset * slope)};
}

}  // namespace fanbeam::signal
