#include "atmosphere/precipitation/rain.h"

#include <array>
#include <cmath>
#include <span>

#include "atmosphere/input_check.h"
#include "atmosphere/precipitation/drop_scattering.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr NameTable<RainLaw, 3> kRainLawNames = {{{"itu-p838", RainLaw::itu_p838},
                                                  {"georgia-tech-95", RainLaw::georgia_tech_95},
                                                  {"mie", RainLaw::mie}}};

// One Gaussian of the regressions: a exp(-((x - b)/c)^2) with x = log10 of the frequency in GHz.
struct Term {
  double a, b, c;
};

// P.838-3 Tables 1 to 4. The last two terms of alpha V nearly cancel: every printed digit counts.
constexpr std::array<Term, 4> kTermsKH = {{{-5.33980, -0.10008, 1.13098},
                                           {-0.35351, 1.26970, 0.45400},
                                           {-0.23789, 0.86036, 0.15354},
                                           {-0.94158, 0.64552, 0.16817}}};
constexpr std::array<Term, 4> kTermsKV = {{{-3.80595, 0.56934, 0.81061},
                                           {-3.44965, -0.22911, 0.51059},
                                           {-0.39902, 0.73042, 0.11899},
                                           {0.50167, 1.07319, 0.27195}}};
constexpr std::array<Term, 5> kTermsAlphaH = {{{-0.14318, 1.82442, -0.55187},
                                               {0.29591, 0.77564, 0.19822},
                                               {0.32177, 0.63773, 0.13164},
                                               {-5.37610, -0.96230, 1.47828},
                                               {16.1721, -3.29980, 3.43990}}};
constexpr std::array<Term, 5> kTermsAlphaV = {{{-0.07771, 2.33840, -0.76284},
                                               {0.56727, 0.95545, 0.54039},
                                               {-0.20238, 1.14520, 0.26809},
                                               {-48.2991, 0.791669, 0.116226},
                                               {48.5833, 0.791459, 0.116479}}};

double regression(std::span<const Term> terms, double slope, double constant, double x) {
  double sum = slope * x + constant;
  for (const Term& term : terms) {
    const double offset = (x - term.b) / term.c;
    sum += term.a * std::exp(-offset * offset);
  }
  return sum;
}

}  // namespace

RainLaw rain_law_named(std::string_view name) {
  return choice_named(kRainLawNames, "rain_law", name);
}

std::string_view name_of(RainLaw law) { return name_in(kRainLawNames, law); }

RainCoefficients rain_coefficients(double frequency_Hz, double path_elevation_rad,
                                   double polarisation_tilt_rad) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, 1e9, 1e12);
  core::check_range(problems, "path_elevation_rad", path_elevation_rad,
                    {-core::kPi / 2, core::kPi / 2}, "rad");
  core::check_range(problems, "polarisation_tilt_rad", polarisation_tilt_rad,
                    {-core::kPi, core::kPi}, "rad");
  problems.throw_if_errors();

  const double x = std::log10(frequency_Hz * 1e-9);
  const double k_H = std::pow(10.0, regression(kTermsKH, -0.18961, 0.71147, x));
  const double k_V = std::pow(10.0, regression(kTermsKV, -0.16398, 0.63297, x));
  const double alpha_H = regression(kTermsAlphaH, 0.67849, -1.95537, x);
  const double alpha_V = regression(kTermsAlphaV, -0.053739, 0.83433, x);

  const double cos_elevation = std::cos(path_elevation_rad);
  const double q = cos_elevation * cos_elevation * std::cos(2.0 * polarisation_tilt_rad);
  const double k = (k_H + k_V + (k_H - k_V) * q) / 2.0;
  const double k_alpha =
      (k_H * alpha_H + k_V * alpha_V + (k_H * alpha_H - k_V * alpha_V) * q) / 2.0;
  return {k, k_alpha / k};
}

double rain_attenuation_dB_per_km(RainLaw law, double rain_rate_mm_per_h, double frequency_Hz,
                                  double path_elevation_rad, double polarisation_tilt_rad,
                                  const RainDrops& drops) {
  core::require_range("rain_rate_mm_per_h", rain_rate_mm_per_h, {0.0, kLargestRainRate_mm_per_h},
                      "mm/h");
  RainCoefficients coefficients =
      rain_coefficients(frequency_Hz, path_elevation_rad, polarisation_tilt_rad);
  if (law == RainLaw::georgia_tech_95) {
    require_frequency(frequency_Hz, 90e9, 100e9, "the rain law georgia-tech-95");
    coefficients = {1.6, 0.64};
  }
  if (rain_rate_mm_per_h == 0.0) return 0.0;
  if (law == RainLaw::mie)
    return DropScattering(frequency_Hz, drops.temperature_C)
        .attenuation_dB_per_km(drops.sizes, rain_rate_mm_per_h);
  return coefficients.k * std::pow(rain_rate_mm_per_h, coefficients.alpha);
}

}  // namespace fanbeam::atmosphere
