// Least-squares fit of the Phong-like form to any reflectivity model or measurement, in decibels
// with equal weights.
//
// For a fixed exponent c and a fixed ratio b : a the best scale is the mean dB difference, so two
// unknowns remain. Both are searched on a grid and then refined by golden section, the ratio inside
// the exponent; the two bounds a = 0 and b = 0 are tried as well. The search finds the least RMS
// over c in [1, 100], a, b >= 0; there is no starting point that could be badly chosen. Accuracy:
// parameters of exact Phong data are recovered to 1e-4 relative.
#pragma once

#include <functional>
#include <vector>

#include "materials/nrcs/phong_nrcs.h"
#include "materials/nrcs/tabulated.h"

namespace fanbeam::materials {

struct PhongFit {
  PhongNrcs nrcs;
  double rms_dB = 0.0;  // deviation of the fit from the samples
  double max_dB = 0.0;
};

// At least three samples, grazing in (0, pi/2], sigma0 in [1e-30, 1e6]; else InputError E-RANGE or
// E-NONFINITE. With b = 0 the exponent is given as 1.
PhongFit fit_phong(const std::vector<NrcsSample>& samples);

// Grazing angles of the project's fits: 1, 1.5, 2, 3, 4, 5, 7, 10, 15, 20, 25, 30, 40, 50, 60 deg.
// Steeper angles are left out because coherent echoes are in none of the models.
const std::vector<double>& standard_fit_angles_deg();

// The model sampled at the given angles.
std::vector<NrcsSample> sample_model(const std::function<double(double grazing_rad)>& sigma0,
                                     const std::vector<double>& grazing_deg);

}  // namespace fanbeam::materials
