#include "renderer/stages/bistatic_nrcs.h"

#include "core/constants.h"

namespace fanbeam::renderer {

double scattered_share(const NrcsTable& nrcs, double sin_in) {
  constexpr int kSines = 32, kTurns = 48;
  const double cos_in = std::sqrt(std::fmax(1.0 - sin_in * sin_in, 0.0));
  double sum = 0.0;
  for (int i = 0; i < kSines; ++i) {
    const double sin_out = (i + 0.5) / kSines;
    const double cos_out = std::sqrt(1.0 - sin_out * sin_out);
    for (int k = 0; k < kTurns; ++k) {
      // Narrow lobes lie around the mirror direction, turn 0: steps are finest there.
      const double part = (k + 0.5) / kTurns;
      const double turn_rad = core::kPi * part * part;
      const double width_rad = 2.0 * core::kPi * part / kTurns;
      // |sum of the two unit vectors out of the surface|^2 = 2 (1 + their product).
      const double product = sin_in * sin_out - cos_in * cos_out * std::cos(turn_rad);
      const double length = std::sqrt(std::fmax(2.0 * (1.0 + product), 1e-30));
      const double on_half = std::fmin((sin_in + sin_out) / length, 1.0);
      sum += bistatic_sigma0_over_sine(nrcs, sin_in, sin_out, on_half) * width_rad;
    }
  }
  return 2.0 * sum / kSines / (4.0 * core::kPi);
}

}  // namespace fanbeam::renderer
