#include <fmt/core.h>

#include <map>

#include "materials/dielectric/building_materials.h"
#include "materials/dielectric/fresnel.h"
#include "materials/dielectric/snow.h"
#include "materials/dielectric/soil.h"
#include "materials/dielectric/water_ice.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

using materials::BuildingMaterial;
using materials::Permittivity;

Permittivity permittivity(const std::string& material, double frequency_Hz) {
  if (material == "water_20C") return materials::water_permittivity(frequency_Hz, 293.15);
  if (material == "water_0C") return materials::water_permittivity(frequency_Hz, 273.15);
  if (material == "ice_-5C") return materials::ice_permittivity(frequency_Hz, 268.15);
  if (material == "dry_snow_rho0.3") return materials::dry_snow_permittivity(300.0);
  static const std::map<std::string, BuildingMaterial> kBuilding = {
      {"concrete", BuildingMaterial::concrete},
      {"glass", BuildingMaterial::glass},
      {"metal", BuildingMaterial::metal}};
  return materials::building_permittivity(kBuilding.at(material), frequency_Hz);
}

const char* const kSource =
    "ITU-R P.2040-3 Table 3 (concrete, glass, metal), Liebe, Hufford and Manabe 1991 (water), "
    "Maetzler 2006 (ice), Kendra 1998 (dry snow); evaluated by another program";

Section permittivities() {
  Section section{"Permittivity",
                  kSource,
                  "",
                  Section::Measure::relative,
                  2e-2,
                  "four decimals are printed, which is two digits for the loss of ice"};
  for (const tests::DataRow& row : tests::data_rows("fresnel_check_values.csv")) {
    const Permittivity ours = permittivity(row.text("material"), row.number("frequency_GHz") * 1e9);
    const std::string at =
        fmt::format("{} at {} GHz", row.text("material"), row.text("frequency_GHz"));
    section.add(at + ", real", ours.real, row.number("permittivity_real"));
    section.add(at + ", loss", ours.loss, row.number("permittivity_loss"));
  }
  return section;
}

Section reflectivities() {
  Section section{"Fresnel: power reflectivity at normal incidence",
                  kSource,
                  "",
                  Section::Measure::difference,
                  6e-6,
                  "five decimals are printed"};
  for (const tests::DataRow& row : tests::data_rows("fresnel_check_values.csv"))
    section.add(fmt::format("{} at {} GHz", row.text("material"), row.text("frequency_GHz")),
                materials::normal_reflectivity(
                    permittivity(row.text("material"), row.number("frequency_GHz") * 1e9)),
                row.number("normal_reflectivity"));
  return section;
}

Section wet_snow() {
  Section section{
      "Permittivity: wet snow",
      "Ulaby and Long, Microwave Radar and Radiometric Remote Sensing (2014), figures "
      "4-22 and 4-23, as read off by the authors of the SMRT model; the model is that of "
      "Hallikainen, Ulaby and Abdelrazik 1986",
      "",
      Section::Measure::difference,
      1e-3,
      "three decimals were read off"};
  for (const tests::DataRow& row : tests::data_rows("wet_snow_figures.csv")) {
    const Permittivity ours = materials::wet_snow_permittivity(
        {250.0, row.number("water_percent") / 100.0}, row.number("frequency_GHz") * 1e9);
    const std::string at =
        fmt::format("{} GHz, {} % water", row.text("frequency_GHz"), row.text("water_percent"));
    section.add(at + ", real", ours.real, row.number("permittivity_real"));
    section.add(at + ", loss", ours.loss, row.number("permittivity_loss"));
  }
  return section;
}

Section soil() {
  Section section{"Permittivity: soil",
                  "the four soils of Recommendation ITU-R P.527-6, section 5.2, 23 C, evaluated by "
                  "another program with the term for low frequencies that we leave out",
                  "",
                  Section::Measure::relative,
                  9e-3,
                  "that term: 0.8 % at 10 GHz, falling with 1 / f^2"};
  for (const tests::DataRow& row : tests::data_rows("soil_permittivity.csv")) {
    materials::Soil soil;
    soil.sand_mass_fraction = row.number("sand");
    soil.clay_mass_fraction = row.number("clay");
    soil.grain_density_kg_per_m3 = row.number("grain_g_per_cm3") * 1000.0;
    soil.bulk_density_kg_per_m3 = row.number("bulk_g_per_cm3") * 1000.0;
    soil.moisture_volume_fraction = row.number("moisture");
    const Permittivity ours =
        materials::soil_permittivity(soil, row.number("frequency_GHz") * 1e9, 296.15);
    const std::string at = fmt::format("{}, {} GHz, moisture {}", row.text("soil"),
                                       row.text("frequency_GHz"), row.text("moisture"));
    section.add(at + ", real", ours.real, row.number("permittivity_real"));
    section.add(at + ", loss", ours.loss, row.number("permittivity_loss"));
  }
  return section;
}

}  // namespace

std::vector<Section> dielectric_sections() {
  return {permittivities(), reflectivities(), wet_snow(), soil()};
}

}  // namespace fanbeam::validation
