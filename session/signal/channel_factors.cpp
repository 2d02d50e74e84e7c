#include "session/signal/channel_factors.h"

#include <cmath>

namespace fanbeam::session {

std::vector<std::complex<double>> channel_factors(const std::vector<double>& gains_dB,
                                                  const std::vector<double>& phases_rad,
                                                  int channels) {
  std::vector<std::complex<double>> factors;
  for (std::size_t i = 0; i < static_cast<std::size_t>(channels); ++i)
    factors.push_back(std::polar(gains_dB.empty() ? 1.0 : std::pow(10.0, 0.05 * gains_dB[i]),
                                 phases_rad.empty() ? 0.0 : phases_rad[i]));
  return factors;
}

}  // namespace fanbeam::session
