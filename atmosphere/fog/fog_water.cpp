#include "atmosphere/fog/fog_water.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/input_check.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr NameTable<FogWaterModel, 6> kFogWaterModelNames = {
    {{"kunkel", FogWaterModel::kunkel},
     {"eldridge-altshuler", FogWaterModel::eldridge_altshuler},
     {"zhao-radiation", FogWaterModel::zhao_radiation},
     {"zhao-advection", FogWaterModel::zhao_advection},
     {"tomasi-dry-cold", FogWaterModel::tomasi_dry_cold},
     {"tomasi-wet-warm", FogWaterModel::tomasi_wet_warm}}};

struct PowerLaw {
  double c_km;
  double n;
};

PowerLaw power_law(FogWaterModel model) {
  switch (model) {
    case FogWaterModel::kunkel:
      return {3.912 / 144.7, 1.0 / 0.88};
    case FogWaterModel::eldridge_altshuler:
      return {0.024, 1.54};
    case FogWaterModel::zhao_radiation:
      return {1.0 / 42.0, 1.54};
    case FogWaterModel::zhao_advection:
      return {1.0 / 18.35, 1.43};
    case FogWaterModel::tomasi_dry_cold:
      return {0.034, 1.5};
    case FogWaterModel::tomasi_wet_warm:
      return {0.060, 1.5};
  }
  throw core::InternalError("unknown fog water model");
}

}  // namespace

FogWaterModel fog_water_model_named(std::string_view name) {
  return choice_named(kFogWaterModelNames, "fog_type", name);
}

std::string_view name_of(FogWaterModel model) { return name_in(kFogWaterModelNames, model); }

double liquid_water_g_per_m3(FogWaterModel model, double visibility_m) {
  core::require_range("visibility_m", visibility_m, {10.0, 100000.0}, "m");
  const PowerLaw law = power_law(model);
  return std::pow(law.c_km / (visibility_m * 1e-3), law.n);
}

double visibility_m(FogWaterModel model, double liquid_water_g_per_m3) {
  core::require_range("liquid_water_g_per_m3", liquid_water_g_per_m3, {1e-300, 1e3}, "g/m3");
  const PowerLaw law = power_law(model);
  return std::clamp(1e3 * law.c_km / std::pow(liquid_water_g_per_m3, 1.0 / law.n), 10.0, 100000.0);
}

}  // namespace fanbeam::atmosphere
