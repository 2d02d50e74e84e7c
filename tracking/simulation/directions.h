// Directions of the one or two plane waves that make up a snapshot of an array.
#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::tracking {

// Of c / (N d): nearer than that, two waves in phase leave of one no more than 1e-4 of the energy, which two_tones.h asks for.
inline constexpr double kLeastDirections = 1.0 / 6.0;

// The strongest wave, and a second one where it has at least a tenth of its power. From one and a half
// beamwidths apart each is fitted to what the other leaves, ten times in turn (J. Li, P. Stoica,
// "Efficient mixed-spectrum estimation", IEEE Trans. SP-44, 1996); nearer, down to `least_apart` of c / (N
// d), both at once (signal/detection/two_tones.h): taking turns is 10 to 40 mrad off there after ten.
// `elements_m` along y at even pitch, two or more, or none to tell apart; `noise_W` of one element.
// Azimuths in radians, the stronger first. Errors as of signal/angle/angle_peak.h.
std::vector<double> directions_rad(const std::vector<std::complex<double>>& snapshot,
                                   const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                                   double beam_sine, double noise_W,
                                   double least_apart = 1.0 / 3.0);

// How well these one or two directions can be known: the Cramer-Rao bound
// (signal/detection/tone_bound.h), at most half of lambda / (N d); any direction for less than two elements.
// Of an array of `pitch_wavelengths`.
std::vector<double> direction_sigmas_rad(const std::vector<std::complex<double>>& snapshot,
                                         const std::vector<double>& directions_rad,
                                         double pitch_wavelengths, double noise_W);

// Whether the wave from there is all but `share` of the energy, and four times the noise of all elements.
bool is_lone_wave(const std::vector<std::complex<double>>& snapshot,
                  const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                  double azimuth_rad, double share, double noise_W);

}  // namespace fanbeam::tracking
