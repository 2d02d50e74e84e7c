// Gain and phase of every channel as one factor.
#pragma once

#include <complex>
#include <vector>

namespace fanbeam::session {

// 10^(dB / 20) exp(j rad); an empty list counts as zeros, others have `channels` numbers.
std::vector<std::complex<double>> channel_factors(const std::vector<double>& gains_dB,
                                                  const std::vector<double>& phases_rad,
                                                  int channels);

}  // namespace fanbeam::session
