// Directions and powers of the plane waves that make up one snapshot of an array.
//
//   beamforming  the one wave that fits best (signal/angle/angle_peak.h)
//   capon, music the peaks of those spectra (signal/angle/spatial_spectrum.h) over the covariance
//                smoothed forwards and backwards over sub-arrays of two thirds of a uniform line,
//                then every wave fitted to what the others leave, in turn (RELAX), with the whole
//                aperture
// How many: at most, for music, as many as there are eigenvalues of the smoothed covariance above
// kLeastOverNoise times the noise of an element; for capon, peaks that far above it. Of these, the
// strongest first, one more is kept as long as it lowers what is left over by kLeastOverNoise times
// the noise (noise alone does in one of a million), has a hundredth of the strongest one's power and
// is a fifth of a beamwidth away. So a lone wave stays one, with the maximum-likelihood error.
//
// Sources: S. U. Pillai, B. H. Kwon, IEEE Trans. ASSP-37, 1989 (smoothing); J. Li, P. Stoica, IEEE
// Trans. SP-44, 1996 (in turn).
// Inputs: one value per element, finite; noise 0 or more. Capon and music need elements on a line
// at one pitch, four or more, in order (E-UNSUPPORTED; fewer than four are beamformed). Neglected:
// waves out of the plane of a line.
#pragma once

#include <complex>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace fanbeam::signal {

enum class AngleMethod { beamforming, capon, music };

// "beamforming", "capon", "music".
std::string_view name(AngleMethod method);
std::optional<AngleMethod> angle_method(std::string_view name);

struct SourceDirection {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double power_W = 0.0;
};

inline constexpr double kLeastOverNoise = 16.0;
inline constexpr std::size_t kFewestElements = 4;  // of capon and music

// The strongest first; never empty.
std::vector<SourceDirection> source_directions(const std::vector<std::complex<double>>& snapshot,
                                               const std::vector<glm::dvec3>& elements_m,
                                               double wavelength_m, AngleMethod method,
                                               double noise_W);

}  // namespace fanbeam::signal
