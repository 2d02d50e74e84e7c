// Phong-like surface reflectivity, the form every material of a scene is evaluated in.
//
//   sigma0 = a sin(psi) + b sin(psi)^c,   a, b >= 0, c >= 0        [m2 per m2 of surface]
//
// psi is the local grazing angle on the facet, so sin(psi) is the cosine between the facet's normal
// and the direction to the radar. The form is that of Peinecke, Doehler and Korn (SPIE 7117, 2008;
// JAIS 10(7), 2013); for a monostatic radar it is Blinn-Phong shading: a constant-gamma part and a
// lobe around the normal. The coefficients are our own fits (see phong_fit.h and
// docs/materials.md), not those of the papers.
//
// With c below 1 the form falls more slowly than sin(psi) towards grazing, as urban blocks do, and
// c = 0 is a constant; the shipped library keeps to c >= 1.
//
// Neglected: azimuth dependence and the coherent echo near vertical incidence.
#pragma once

#include <cmath>

namespace fanbeam::materials {

class PhongNrcs {
 public:
  // A surface that returns nothing.
  PhongNrcs() = default;

  // Throws InputError: E-NONFINITE for NaN or infinity, E-RANGE for a or b outside 0 to 1e6 or c
  // outside 0 to 1000.
  PhongNrcs(double a, double b, double c);

  // Zero for back faces (not mirrored) and at psi = 0. For sin_grazing in [0, 1] never negative, at
  // most a + b.
  double sigma0(double sin_grazing) const noexcept {
    if (!(sin_grazing > 0.0)) return 0.0;
    const double diffuse = a_ * sin_grazing;
    return b_ == 0.0 ? diffuse : diffuse + b_ * std::pow(sin_grazing, c_);
  }

  double a() const { return a_; }
  double b() const { return b_; }
  double c() const { return c_; }

 private:
  double a_ = 0.0;
  double b_ = 0.0;
  double c_ = 1.0;
};

inline constexpr double kLargestPhongCoefficient = 1e6;
inline constexpr double kLargestPhongExponent = 1000.0;

}  // namespace fanbeam::materials
