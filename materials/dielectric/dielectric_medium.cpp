#include "materials/dielectric/dielectric_medium.h"

#include <array>

#include "core/errors.h"
#include "core/number_range.h"
#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/snow.h"
#include "materials/dielectric/soil.h"
#include "materials/dielectric/water_ice.h"

namespace fanbeam::materials {
namespace {

// In the order of DielectricMedium.
constexpr std::array<const char*, 15> kNames = {
    "concrete", "brick", "plasterboard", "wood",     "glass",    "marble",     "asphalt", "metal",
    "water",    "ice",   "dry_snow",     "wet_snow", "dry_soil", "moist_soil", "wet_soil"};

constexpr double kDrySnowDensity_kg_per_m3 = 300.0;

std::optional<BuildingMaterial> building_material(DielectricMedium medium) {
  switch (medium) {
    case DielectricMedium::concrete:
      return BuildingMaterial::concrete;
    case DielectricMedium::brick:
      return BuildingMaterial::brick;
    case DielectricMedium::plasterboard:
      return BuildingMaterial::plasterboard;
    case DielectricMedium::wood:
      return BuildingMaterial::wood;
    case DielectricMedium::glass:
      return BuildingMaterial::glass;
    case DielectricMedium::marble:
      return BuildingMaterial::marble;
    case DielectricMedium::asphalt:
      return BuildingMaterial::asphalt_concrete;
    case DielectricMedium::metal:
      return BuildingMaterial::metal;
    default:
      return std::nullopt;
  }
}

Soil loam(double moisture_volume_fraction) {
  Soil soil;
  soil.moisture_volume_fraction = moisture_volume_fraction;
  return soil;
}

}  // namespace

const char* name_of(DielectricMedium medium) { return kNames.at(static_cast<std::size_t>(medium)); }

std::optional<DielectricMedium> dielectric_medium_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return static_cast<DielectricMedium>(i);
  return std::nullopt;
}

std::vector<std::string> dielectric_medium_names() { return {kNames.begin(), kNames.end()}; }

Permittivity permittivity_of(DielectricMedium medium, double frequency_Hz, double temperature_K) {
  if (const auto building = building_material(medium))
    return building_permittivity(*building, frequency_Hz);
  switch (medium) {
    case DielectricMedium::water:
      return water_permittivity(frequency_Hz, temperature_K);
    case DielectricMedium::ice:
      return ice_permittivity(frequency_Hz, temperature_K);
    case DielectricMedium::dry_snow:
      core::require_range("frequency_Hz", frequency_Hz,
                          {kDrySnowFrequencies_Hz.low, kDrySnowFrequencies_Hz.high});
      return dry_snow_permittivity(kDrySnowDensity_kg_per_m3);
    case DielectricMedium::wet_snow:
      return wet_snow_permittivity({}, frequency_Hz);
    case DielectricMedium::dry_soil:
      return soil_permittivity(loam(0.05), frequency_Hz, temperature_K);
    case DielectricMedium::moist_soil:
      return soil_permittivity(loam(0.20), frequency_Hz, temperature_K);
    case DielectricMedium::wet_soil:
      return soil_permittivity(loam(0.35), frequency_Hz, temperature_K);
    default:
      throw core::InternalError("dielectric medium out of its enumeration");
  }
}

Interval valid_frequency_Hz(DielectricMedium medium) {
  if (const auto building = building_material(medium)) return building_frequencies_Hz(*building);
  switch (medium) {
    case DielectricMedium::water:
      return kWaterFrequencies_Hz;
    case DielectricMedium::ice:
      return kIceFrequencies_Hz;
    case DielectricMedium::dry_snow:
      return kDrySnowFrequencies_Hz;
    case DielectricMedium::wet_snow:
      return kWetSnowFrequencies_Hz;
    case DielectricMedium::dry_soil:
    case DielectricMedium::moist_soil:
    case DielectricMedium::wet_soil:
      return kSoilFrequencies_Hz;
    default:
      throw core::InternalError("dielectric medium out of its enumeration");
  }
}

std::optional<Interval> valid_temperature_K(DielectricMedium medium) {
  switch (medium) {
    case DielectricMedium::water:
      return Interval{253.15, 333.15};
    case DielectricMedium::ice:
      return Interval{240.0, 273.15};
    case DielectricMedium::dry_soil:
    case DielectricMedium::moist_soil:
    case DielectricMedium::wet_soil:
      return Interval{273.15, 313.15};
    default:
      return std::nullopt;
  }
}

}  // namespace fanbeam::materials
