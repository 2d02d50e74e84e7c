// Direction of the one plane wave that fits a snapshot best: the maximum-likelihood estimate for a
// single scatterer in white noise, the maximum of |sum x_m conj(a_m)|^2.
//
// A scan at a quarter of the beamwidth finds the lobe, golden sections climb it. For one source the
// error follows sigma_azimuth = sqrt(6 / (rho N (N^2 - 1))) / (pi cos azimuth) for a line of N at
// half a wavelength and signal-to-noise ratio rho per element, above the threshold of about 10 dB
// in N rho (P. Stoica, A. Nehorai, IEEE Trans. ASSP-37, 1989). Two sources closer than a beamwidth
// merge: see signal/angle/spatial_spectrum.h. Azimuths are searched from -pi/2 to pi/2, at a given
// elevation; of a uniform line at more than half a wavelength, up to the ambiguity
// (unambiguous_sine of signal/waveform/array.h): farther out every direction looks like one of these, which is told.
//
// Elements that are all in one place tell no direction, and those above each other no azimuth: 0.
//
// Inputs: as many values as elements, at least one, finite. E-RANGE, E-NONFINITE otherwise.
// Accuracy of the climb: 1e-7 rad. Cost: a scan of 16 x L / wavelength + 1 sums over the elements, L
// the distance of the farthest element from the first (9 to 20001 sums), and 45 for a climb.
#pragma once

#include <complex>
#include <glm/vec3.hpp>
#include <vector>

namespace fanbeam::signal {

struct AnglePeak {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double power = 0.0;  // |mean of the aligned channels|^2: that of a channel for a lone wave
};

AnglePeak azimuth_peak(const std::vector<std::complex<double>>& snapshot,
                       const std::vector<glm::dvec3>& elements_m, double wavelength_m,
                       double elevation_rad = 0.0);

// Azimuth and elevation, from -pi/2 to pi/2 each, of an array that has elements at several heights;
// as azimuth_peak where it has none. A scan of both at a quarter of the beamwidth, then the two
// climbed in turn. Elements farther apart than half a wavelength leave directions ambiguous: of equal
// maxima the first, lowest and furthest left, is told.
AnglePeak direction_peak(const std::vector<std::complex<double>>& snapshot,
                         const std::vector<glm::dvec3>& elements_m, double wavelength_m);

}  // namespace fanbeam::signal
