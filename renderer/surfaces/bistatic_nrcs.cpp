#include "renderer/surfaces/bistatic_nrcs.h"

#include <algorithm>
#include <utility>

#include "core/constants.h"

namespace fanbeam::renderer {
namespace {

// Of the sums below; the share must not pass 1 by it.
constexpr double kIntegralError = 0.01;

// Steps around half of a turn about the normal, from the mirror direction on, where narrow lobes
// lie: steps are finest there.
struct Turn {
  double cosine = 0.0, width_rad = 0.0;
};

const std::array<Turn, 48>& turns() {
  static const std::array<Turn, 48> kTurns = [] {
    std::array<Turn, 48> turns;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(turns.size());
      turns[k] = {std::cos(core::kPi * part * part),
                  2.0 * core::kPi * part / static_cast<double>(turns.size())};
    }
    return turns;
  }();
  return kTurns;
}

// `over_sine(sin_out, normal_on_half)` is sigma_B / sin(psi_i).
template <class OverSine>
double integrated_share(double sin_in, const OverSine& over_sine) {
  constexpr int kSines = 32;
  const double cos_in = std::sqrt(std::fmax(1.0 - sin_in * sin_in, 0.0));
  double sum = 0.0;
  for (int i = 0; i < kSines; ++i) {
    const double sin_out = (i + 0.5) / kSines;
    const double cos_out = std::sqrt(1.0 - sin_out * sin_out);
    for (const Turn& turn : turns()) {
      // |sum of the two unit vectors out of the surface|^2 = 2 (1 + their product).
      const double product = sin_in * sin_out - cos_in * cos_out * turn.cosine;
      const double length = std::sqrt(std::fmax(2.0 * (1.0 + product), 1e-30));
      const double on_half = std::fmin((sin_in + sin_out) / length, 1.0);
      sum += over_sine(sin_out, on_half) * turn.width_rad;
    }
  }
  return 2.0 * sum / kSines / (4.0 * core::kPi);
}

}  // namespace

BistaticNrcs::BistaticNrcs(NrcsTable monostatic) : monostatic_(std::move(monostatic)) {
  constexpr double kLowestRoot = 1e-3, kLowestSine = 1.0 / 32.0;
  if (monostatic_.largest() == 0.0) return;
  for (int i = 0; i <= kSteps; ++i) {
    const double root = std::max(static_cast<double>(i) / kSteps, kLowestRoot);
    // sqrt(sin psi_i) times the share, so without that root in the denominator.
    rooted_share_[static_cast<std::size_t>(i)] =
        (1.0 + kIntegralError) *
        integrated_share(root * root, [&](double sin_out, double normal_on_half) {
          return monostatic_.sigma0_over_sine(normal_on_half) * std::sqrt(sin_out);
        });
  }
  rooted_share_[kSteps + 1] = rooted_share_[kSteps];
  for (int i = 0; i <= kSteps; ++i) {
    const double sine = std::max(static_cast<double>(i), kLowestSine) / kSteps;
    share_[static_cast<std::size_t>(i)] = std::fmin(scattered_share(*this, sine), 1.0);
  }
  share_[kSteps + 1] = share_[kSteps];
}

double scattered_share(const BistaticNrcs& nrcs, double sin_in) {
  return integrated_share(sin_in, [&](double sin_out, double normal_on_half) {
    return nrcs.sigma0_over_sine(sin_in, sin_out, normal_on_half);
  });
}

}  // namespace fanbeam::renderer
