#include "atmosphere/fog/fog.h"

#include <complex>

#include "atmosphere/input_check.h"
#include "atmosphere/water_permittivity.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr NameTable<FogLaw, 3> kFogLawNames = {{{"itu-p840", FogLaw::itu_p840},
                                                {"altshuler", FogLaw::altshuler},
                                                {"centimetre", FogLaw::centimetre}}};

// Equations 2 and 11 of P.840-8; symbols as there, f in GHz.
double itu_p840(double f, double temperature_C) {
  const std::complex<double> eps = water_permittivity(f * 1e9, temperature_C);
  const double eta = (2.0 + eps.real()) / eps.imag();
  return 0.819 * f / (eps.imag() * (1.0 + eta * eta));
}

// The laws' ranges are round wavelengths, which their users turn into round frequencies with
// c = 3e8 m/s, 0.07 % above the true ones. Either reading is inside: 15 GHz (19.986 mm) stands for
// 2 cm, and so does 14.9896 GHz. The laws themselves are no better than 1.5 %.
void require_wavelength(double frequency_Hz, double shortest_m, double longest_m,
                        std::string_view law) {
  constexpr double kRoundSpeed_mps = 3e8;
  const double lowest_Hz = kRoundSpeed_mps / longest_m;
  if (frequency_Hz >= core::kSpeedOfLight_mps / longest_m && frequency_Hz < lowest_Hz) return;
  require_frequency(frequency_Hz, lowest_Hz, kRoundSpeed_mps / shortest_m,
                    "the fog law " + std::string(law));
}

}  // namespace

FogLaw fog_law_named(std::string_view name) { return choice_named(kFogLawNames, "fog_law", name); }

std::string_view name_of(FogLaw law) { return name_in(kFogLawNames, law); }

double fog_coefficient(FogLaw law, double frequency_Hz, double temperature_C) {
  core::require_range("temperature_C", temperature_C, {-40.0, 50.0}, "C where there is fog");
  switch (law) {
    case FogLaw::itu_p840:
      require_frequency(frequency_Hz, 1e9, 200e9, "the fog law itu-p840");
      return itu_p840(frequency_Hz * 1e-9, temperature_C);
    case FogLaw::altshuler: {
      require_wavelength(frequency_Hz, 0.003, 0.010, "altshuler");
      core::require_range("temperature_C", temperature_C, {-8.0, 25.0},
                          "C for the fog law altshuler");
      const double wavelength_mm = core::kSpeedOfLight_mps / frequency_Hz * 1e3;
      return -1.347 + 0.0372 * wavelength_mm + 18.0 / wavelength_mm - 0.022 * temperature_C;
    }
    case FogLaw::centimetre: {
      require_wavelength(frequency_Hz, 0.02, 0.10, "centimetre");
      const double wavelength_cm = core::kSpeedOfLight_mps / frequency_Hz * 1e2;
      return 0.438 / (wavelength_cm * wavelength_cm);
    }
  }
  throw core::InternalError("unknown fog law");
}

double fog_attenuation_dB_per_km(FogLaw law, double liquid_water_g_per_m3, double frequency_Hz,
                                 double temperature_C) {
  core::require_range("liquid_water_g_per_m3", liquid_water_g_per_m3,
                      {0.0, kLargestLiquidWater_g_per_m3}, "g/m3");
  return fog_coefficient(law, frequency_Hz, temperature_C) * liquid_water_g_per_m3;
}

}  // namespace fanbeam::atmosphere
