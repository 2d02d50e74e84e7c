// The media that a scene can name, each in one definite state, with the model that answers for it.
//
//   name          model                        state
//   concrete      building_materials.h         as ITU-R P.2040-3 lists it
//   brick         building_materials.h
//   plasterboard  building_materials.h
//   wood          building_materials.h
//   glass         building_materials.h
//   marble        building_materials.h
//   asphalt       building_materials.h         asphalt concrete
//   metal         building_materials.h
//   water         water_ice.h                  pure
//   ice           water_ice.h                  pure
//   dry_snow      snow.h                       300 kg/m3
//   wet_snow      snow.h                       240 kg/m3 of ice and 5 % of the volume liquid water
//   dry_soil      soil.h                       loam, 1578 kg/m3 dry, moisture 0.05 m3/m3
//   moist_soil    soil.h                       loam, moisture 0.20 m3/m3
//   wet_soil      soil.h                       loam, moisture 0.35 m3/m3
//
// The amounts of snow and soil are typical values chosen here, not measurements of any place.
// Temperature matters to water, ice and soil only; wet snow is at the melting point by definition.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "materials/dielectric/permittivity.h"
#include "materials/interval.h"

namespace fanbeam::materials {

enum class DielectricMedium {
  concrete,
  brick,
  plasterboard,
  wood,
  glass,
  marble,
  asphalt,
  metal,
  water,
  ice,
  dry_snow,
  wet_snow,
  dry_soil,
  moist_soil,
  wet_soil,
};

const char* name_of(DielectricMedium medium);
std::optional<DielectricMedium> dielectric_medium_named(std::string_view name);
// All names in the order of the enumeration, for messages.
std::vector<std::string> dielectric_medium_names();

// Throws InputError E-RANGE or E-NONFINITE outside valid_frequency_Hz and outside the model's
// temperatures: water 253.15 to 333.15 K, ice 240 to 273.15 K, soil 273.15 to 313.15 K. Media
// whose model does not use the temperature accept every value.
Permittivity permittivity_of(DielectricMedium medium, double frequency_Hz, double temperature_K);

Interval valid_frequency_Hz(DielectricMedium medium);
// The temperatures above; nothing for a medium that accepts every one.
std::optional<Interval> valid_temperature_K(DielectricMedium medium);

}  // namespace fanbeam::materials
