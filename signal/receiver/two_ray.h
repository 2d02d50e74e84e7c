// Direct ray and ray by a reflecting plane between two points above it.
//
//   r - d = ((h1 + h2)^2 - (h1 - h2)^2) / (r + d) = 4 h1 h2 / (r + d)
// so that two nearly equal roots are never subtracted. One-way power factor
//   F^2 = |1 + Gamma (d / r) exp(-j 2 pi (r - d) / lambda)|^2 ,
// the echo of a point target scales with F^4.
// Source: M. I. Skolnik, "Introduction to Radar Systems", 3rd ed., 8.2.
// Neglected: curvature and roughness of the plane, and its dependence on angle, which are in Gamma;
// antenna patterns.
// Accuracy: the difference to 1e-15 of itself.
#pragma once

#include <complex>

namespace fanbeam::signal {

// Heights 0 or above, ground distance above 0; E-RANGE otherwise.
double path_difference_m(double height_m, double other_height_m, double ground_distance_m);

// F^2; `reflection` is Gamma, -1 for a smooth road at grazing angles.
double two_ray_factor(double height_m, double other_height_m, double ground_distance_m,
                      double wavelength_m, std::complex<double> reflection);

}  // namespace fanbeam::signal
