// One interface for every reflectivity model: the closed list of models, their value, and where
// each is known.
//
// Frequency and polarisation. A model is known between two frequencies and for one or both
// polarisations (ModelValidity). sigma0() refuses what lies outside. A scene may allow to go on
// outside (NrcsCurve): then the Phong-like form is scaled with its frequency exponent, every other
// model keeps the value of the nearest frequency it knows, and an unknown polarisation takes the
// one that is known. Nothing else is made up.
//
// Grazing angle. It cannot be refused picture cell by picture cell, so every model gives a value at
// every angle:
//   at 0 and below           0 (back faces)
//   below 0.1 deg            the value of 0.1 deg times sin(psi) / sin(0.1 deg), so that no
//                            logarithm or floor decides there. The Phong-like form and constant
//                            gamma keep their own law, which ends in 0 by itself.
//   below the source's range the formula goes on
//   above the source's range the formula goes on; Kulemin, GIT and NRL are held at the value of
//                            60 deg from there on: none of them contains the coherent echo of
//                            steep angles, and NRL's term in psi^2 would grow by 24 dB.
// ModelValidity::grazing_rad is what the source covers.
//
// Ranges, sources and accuracy of the models are in their own headers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/constants.h"
#include "core/polarisation.h"
#include "materials/dielectric/dielectric_medium.h"
#include "materials/interval.h"
#include "materials/nrcs/constant_gamma.h"
#include "materials/nrcs/git_land.h"
#include "materials/nrcs/kulemin.h"
#include "materials/nrcs/phong_nrcs.h"
#include "materials/nrcs/rough_metal.h"
#include "materials/nrcs/tabulated.h"

namespace fanbeam::materials {

using core::Polarisation;

// A Phong-like form fitted to something at one frequency. The ranges are those of that something.
struct PhongSurface {
  PhongNrcs nrcs;  // at the reference frequency
  double reference_frequency_Hz = 35e9;
  double frequency_exponent = 0.0;
  Interval frequency_range_Hz{1e9, 300e9};
  Interval grazing_range_rad{0.0, core::kPi / 2.0};
  std::optional<Polarisation> polarisation;  // missing where it was not told apart

  // a (f / f_ref)^n, b (f / f_ref)^n, c: exact for a reference that separates into angle and
  // frequency, a straight line in decibels for the others.
  PhongNrcs at_frequency(double frequency_Hz) const;
};

struct ConstantGammaSurface {
  GammaTerrain terrain = GammaTerrain::flatland;
};

struct KuleminSurface {
  KuleminTerrain terrain = KuleminTerrain::grass_above_half_metre;
};

struct GitLandSurface {
  GitTerrain terrain = GitTerrain::grass;
};

struct NrlSeaSurface {
  double sea_state = 0.0;  // 0 to 6
};

struct OhSurface {
  std::variant<Permittivity, DielectricMedium> medium;  // a figure holds at every frequency
  double rms_height_m = 1e-3;
  double temperature_K = 288.15;
};

struct TabulatedSurface {
  TabulatedNrcs table{{{core::kPi / 2.0, 0.0}}};
  Interval frequency_range_Hz;
  std::optional<Polarisation> polarisation;  // missing for both
};

using SurfaceModel =
    std::variant<PhongSurface, ConstantGammaSurface, KuleminSurface, GitLandSurface, NrlSeaSurface,
                 OhSurface, RoughMetal, TabulatedSurface>;

inline constexpr double kLowestGrazing_rad = 0.1 * core::kPi / 180.0;
inline constexpr double kSteepestEmpiricalGrazing_rad = 60.0 * core::kPi / 180.0;

struct ModelValidity {
  Interval frequency_Hz;
  Interval grazing_rad;
  bool horizontal = true, vertical = true;

  bool knows(Polarisation polarisation) const {
    return polarisation == Polarisation::horizontal ? horizontal : vertical;
  }
};
ModelValidity validity_of(const SurfaceModel& model);

std::string_view name_of(const SurfaceModel& model);    // "kulemin": as files name it
std::string_view source_of(const SurfaceModel& model);  // a document, for people

// What a frequency and polarisation ask beyond a model's validity, empty where it is known.
struct Extrapolation {
  std::string quantity;  // "frequency_GHz" or "polarisation"
  std::string asked;
  std::string known;  // "0.5 to 35", "HH"
};
std::vector<Extrapolation> extrapolations_of(const SurfaceModel& model, Polarisation polarisation,
                                             double frequency_Hz);

// Throws InputError: E-RANGE outside the model's frequencies and polarisations (with the allowed
// range), for grazing angles beyond +-pi/2 and for impossible parameters; E-NONFINITE.
double sigma0(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz,
              double grazing_rad);

// The same without the refusal of frequency (0.1 to 300 GHz) and polarisation: outside, the rules
// at the top of this file hold.
double continued_sigma0(const SurfaceModel& model, Polarisation polarisation, double frequency_Hz,
                        double grazing_rad);

}  // namespace fanbeam::materials
