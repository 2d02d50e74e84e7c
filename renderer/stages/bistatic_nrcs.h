// Reflectivity between two directions from a monostatic curve.
//
//     sigma_B = sqrt(sin psi_i sin psi_s) gamma(n.h),   gamma(x) = sigma0(x) / x
//
// psi_i, psi_s: grazing angles of the incoming and the outgoing ray, h half way between their
// directions, n the surface's normal. Two known rules in one: where gamma does not depend on the
// angle it is the bistatic constant-gamma law of N. J. Willis, Bistatic Radar (2nd ed. 1995),
// section 9.2 [recalled]; a lobe of gamma stays around the mirror direction, as the
// monostatic-bistatic equivalence (R. E. Kell, Proc. IEEE 53, 1965) says of the bisector. It is
// reciprocal, monostatic where the directions meet, and never above sigma0(n.h).
// Neglected: dependence on the plane of scattering, cross polarisation. Accuracy: not known;
// measured bistatic land clutter spreads by 10 dB.
#pragma once

#include <cmath>

#include "renderer/casting/nrcs_table.h"

namespace fanbeam::renderer {

// sigma_B / sin(psi_i); 0 when a sine is not positive.
inline double bistatic_sigma0_over_sine(const NrcsTable& nrcs, double sin_in, double sin_out,
                                        double normal_on_half) noexcept {
  if (!(sin_in > 0.0 && sin_out > 0.0)) return 0.0;
  return nrcs.sigma0_over_sine(normal_on_half) * std::sqrt(sin_out / sin_in);
}

// Share of the power arriving at a grazing angle that the surface scatters into the half space:
// the integral of sigma_B / (4 pi sin psi_i) over all directions; relative error about 1e-2.
double scattered_share(const NrcsTable& nrcs, double sin_in);

}  // namespace fanbeam::renderer
