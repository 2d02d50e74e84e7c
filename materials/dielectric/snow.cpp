#include "materials/dielectric/snow.h"

#include <cmath>

#include "core/number_range.h"

namespace fanbeam::materials {

Permittivity dry_snow_permittivity(double density_kg_per_m3) {
  core::require_range("density_kg_per_m3", density_kg_per_m3, {0.0, 500.0});
  const double density_g_per_cm3 = density_kg_per_m3 / 1000.0;
  return {1.0 + 1.7 * density_g_per_cm3 + 0.7 * density_g_per_cm3 * density_g_per_cm3, 0.0};
}

Permittivity wet_snow_permittivity(const WetSnow& snow, double frequency_Hz) {
  core::require_range("dry_density_kg_per_m3", snow.dry_density_kg_per_m3, {90.0, 380.0});
  core::require_range("liquid_volume_fraction", snow.liquid_volume_fraction, {0.01, 0.12});
  core::require_range("frequency_Hz", frequency_Hz,
                      {kWetSnowFrequencies_Hz.low, kWetSnowFrequencies_Hz.high});
  const double f_GHz = frequency_Hz / 1e9;
  const double density_g_per_cm3 = snow.dry_density_kg_per_m3 / 1000.0;
  const double water_percent = 100.0 * snow.liquid_volume_fraction;

  const double a1 = 0.78 + 0.03 * f_GHz - 0.58e-3 * f_GHz * f_GHz;
  const double a2 = 0.97 - 0.39e-2 * f_GHz + 0.39e-3 * f_GHz * f_GHz;
  const double b1 = 0.31 - 0.05 * f_GHz + 0.87e-3 * f_GHz * f_GHz;
  const double far_above =
      a1 * (1.0 + 1.83 * density_g_per_cm3 + 0.02 * std::pow(water_percent, 1.015)) + b1;
  const double relaxations = f_GHz / 9.07;
  const double water = 0.073 * std::pow(water_percent, 1.31) / (1.0 + relaxations * relaxations);
  return {far_above + a1 * water, a2 * relaxations * water};
}

}  // namespace fanbeam::materials
