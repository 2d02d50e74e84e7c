#include "signal/fourier/unwrap.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/constants.h"

namespace fanbeam::signal {

std::vector<double> unwrapped(const std::vector<double>& phases_rad) {
  constexpr double kTurn = 2.0 * core::kPi;
  constexpr double kTie_rad = 1e-12;
  std::vector<double> result(phases_rad.size(), std::numeric_limits<double>::quiet_NaN());
  double turns = 0.0;
  double last_rad = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < phases_rad.size(); ++i) {
    const double phase_rad = phases_rad[i];
    if (!std::isfinite(phase_rad)) continue;
    // Brings the step into (-pi, pi], both ends moved up by the tie's width.
    if (std::isfinite(last_rad))
      turns -= std::ceil((phase_rad - last_rad - core::kPi - kTie_rad) / kTurn);
    result[i] = phase_rad + kTurn * turns;
    last_rad = phase_rad;
  }
  return result;
}

}  // namespace fanbeam::signal
