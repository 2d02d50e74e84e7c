// Reflectivity between two directions from a monostatic curve.
//
//     sigma_B = f sqrt(sin psi_i sin psi_s) gamma(n.h),   gamma(x) = sigma0(x) / x
//     f = min(1, 1 / w(psi_i), 1 / w(psi_s)),   w the scattered share with f = 1
//
// psi_i, psi_s: grazing angles of the incoming and the outgoing ray, h half way between their
// directions, n the surface's normal. Two known rules in one: where gamma does not depend on the
// angle it is the bistatic constant-gamma law of N. J. Willis, Bistatic Radar (2nd ed. 1995),
// section 9.2 [recalled]; a lobe of gamma stays around the mirror direction, as the
// monostatic-bistatic equivalence (R. E. Kell, Proc. IEEE 53, 1965) says of the bisector. It is
// reciprocal and never above sigma0(n.h).
// Energy: with f = 1 the share grows as gamma / (3 sqrt(sin psi_i)) towards grazing, without end.
// f keeps it at 1 and is the same in both directions. It is 1 down to about sin psi = (gamma/3)^2,
// for 30 of the library's 34 rows down to 0.5 deg. Where it is not, the form is below the
// monostatic curve also where the directions meet.
// Neglected: dependence on the plane of scattering, cross polarisation. Accuracy: not known;
// measured bistatic land clutter spreads by 10 dB. Where f acts the share is 0.98 to 1.
// Cost: 0.25 ms a material to build, and as much once for what all of them share.
#pragma once

#include <array>
#include <cmath>

#include "renderer/surfaces/nrcs_table.h"

namespace fanbeam::renderer {

class BistaticNrcs {
 public:
  explicit BistaticNrcs(NrcsTable monostatic);

  const NrcsTable& monostatic() const { return monostatic_; }

  // Share of the power arriving at a grazing angle that the surface scatters into the half space:
  // the integral of sigma_B / (4 pi sin psi_i) over all directions, linear between 33 even steps of
  // the sine, at most 1; relative error about 1e-2.
  double scattered(double sin_in) const noexcept {
    const double position = std::fmin(sin_in, 1.0) * kSteps;
    const auto index = static_cast<std::size_t>(position);
    return share_[index] +
           (position - static_cast<double>(index)) * (share_[index + 1] - share_[index]);
  }

  // What a mirror of the surface may have at most.
  double unscattered(double sin_in) const noexcept {
    return std::fmax(1.0 - scattered(sin_in), 0.0);
  }

  // sigma_B / sin(psi_i); 0 when a sine is not positive.
  double sigma0_over_sine(double sin_in, double sin_out, double normal_on_half) const noexcept {
    if (!(sin_in > 0.0 && sin_out > 0.0)) return 0.0;
    return factor(sin_in, sin_out) * monostatic_.sigma0_over_sine(normal_on_half);
  }

 private:
  // sigma_B / sin(psi_i) over gamma(n.h); both sines above 0.
  double factor(double sin_in, double sin_out) const noexcept {
    return std::fmin(largest_factor(sin_in), largest_factor(sin_out)) * std::sqrt(sin_out / sin_in);
  }

  // min(1, 1 / w). What is tabulated is w sqrt(sin psi), over sqrt(sin psi): it has no pole.
  double largest_factor(double sine) const noexcept {
    const double root = std::sqrt(std::fmin(sine, 1.0));
    const auto index = static_cast<std::size_t>(root * kSteps);
    const double between = root * kSteps - static_cast<double>(index);
    const double rooted_share =
        rooted_share_[index] + between * (rooted_share_[index + 1] - rooted_share_[index]);
    return rooted_share > root ? root / rooted_share : 1.0;
  }

  static constexpr int kSteps = 32;
  NrcsTable monostatic_;
  std::array<double, kSteps + 2> rooted_share_{};  // one more, for a sine of 1
  std::array<double, kSteps + 2> share_{};
};

}  // namespace fanbeam::renderer
