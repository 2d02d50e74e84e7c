// Reflectivity of a sheet-metal surface such as a hangar door or the side of a vehicle: a panel
// lobe plus a diffuse part.
//
//   sigma0 = (1 - d) exp(-tan^2(t) / (2 m^2)) / (2 m^2 cos^4(t)) + 2 d sin(psi)
//   d = 1 - exp(-(2 k s)^2),  t = 90 deg - psi
//
// The first term is the geometric-optics limit of a perfectly reflecting surface with Gaussian
// slopes of rms value m (Barrick, IEEE Trans. Antennas Propag. 16(4), 1968; Ulaby, Moore, Fung II
// (1982)): dents, curvature and ribs that the model geometry does not resolve. The
// second term spreads the incoherent fraction d of the intercepted power (Ament's factor at normal
// incidence, rms height s of seams and rivets) evenly over the half-space, which conserves energy:
// isotropic re-radiation of d sin(psi) into 2 pi gives sigma0 = 4 pi d sin(psi) / (2 pi).
// Neglected: edges, cavities, multiple reflection, polarisation. s and m are inputs to be assumed,
// not material constants. Accuracy: with m = 0.2 the lobe's top, 10 to 11 dB, agrees with the
// vehicle lobes of 3GPP TR 38.901.
#pragma once

namespace fanbeam::materials {

struct RoughMetal {
  double rms_slope = 0.2;        // m, 0.01 to 1
  double rms_height_m = 0.2e-3;  // s, 0 to 1 m
};

// Zero at grazing angles of zero and below. Throws InputError E-RANGE or E-NONFINITE.
double rough_metal_sigma0(const RoughMetal& surface, double wavelength_m, double grazing_rad);

}  // namespace fanbeam::materials
