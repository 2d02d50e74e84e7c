#include "materials/dielectric/soil.h"

#include <algorithm>
#include <cmath>

#include "core/number_range.h"
#include "materials/dielectric/water_ice.h"

namespace fanbeam::materials {
namespace {

constexpr double kShape = 0.65;

void check_soil(const Soil& soil, double frequency_Hz, double temperature_K) {
  core::require_range("sand_mass_fraction", soil.sand_mass_fraction, {0.0, 1.0});
  core::require_range("clay_mass_fraction", soil.clay_mass_fraction, {0.0, 1.0});
  core::require_range("sand and clay mass fractions",
                      soil.sand_mass_fraction + soil.clay_mass_fraction, {0.0, 1.0});
  core::require_range("bulk_density_kg_per_m3", soil.bulk_density_kg_per_m3, {800.0, 2000.0});
  core::require_range("grain_density_kg_per_m3", soil.grain_density_kg_per_m3, {2500.0, 2800.0});
  core::require_range("moisture_volume_fraction", soil.moisture_volume_fraction, {0.01, 0.5});
  core::require_range("frequency_Hz", frequency_Hz,
                      {kSoilFrequencies_Hz.low, kSoilFrequencies_Hz.high});
  core::require_range("temperature_K", temperature_K, {273.15, 313.15});
}

}  // namespace

Permittivity soil_permittivity(const Soil& soil, double frequency_Hz, double temperature_K) {
  check_soil(soil, frequency_Hz, temperature_K);
  const double sand = soil.sand_mass_fraction;
  const double clay = soil.clay_mass_fraction;
  const double bulk_g_per_cm3 = soil.bulk_density_kg_per_m3 / 1000.0;
  const double grain_g_per_cm3 = soil.grain_density_kg_per_m3 / 1000.0;
  const double moisture = soil.moisture_volume_fraction;

  const double root = 1.01 + 0.44 * grain_g_per_cm3;
  const double solid = root * root - 0.062;
  const double conductivity_S_per_m =
      -1.645 + 1.939 * bulk_g_per_cm3 - 2.25622 * sand + 1.594 * clay;
  const Permittivity water = water_permittivity(frequency_Hz, temperature_K);
  const double pores = (grain_g_per_cm3 - bulk_g_per_cm3) / (grain_g_per_cm3 * moisture);
  const double water_loss =
      std::max(0.0, water.loss + 18.0 / (frequency_Hz / 1e9) * conductivity_S_per_m * pores);

  const double real_exponent = 1.2748 - 0.519 * sand - 0.152 * clay;
  const double loss_exponent = 1.33797 - 0.603 * sand - 0.166 * clay;
  const double real_part =
      1.0 + bulk_g_per_cm3 / grain_g_per_cm3 * (std::pow(solid, kShape) - 1.0) +
      std::pow(moisture, real_exponent) * std::pow(water.real, kShape) - moisture;
  return {std::pow(real_part, 1.0 / kShape),
          std::pow(moisture, loss_exponent / kShape) * water_loss};
}

}  // namespace fanbeam::materials
