#include <fmt/core.h>

#include <map>

#include "materials/dielectric/fresnel.h"
#include "materials/dielectric/permittivity.h"
#include "tests/validation/report.h"
#include "tests/validation/rows.h"

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
  for (const Row& row : rows_of("fresnel_check_values.csv")) {
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
  for (const Row& row : rows_of("fresnel_check_values.csv"))
    section.add(fmt::format("{} at {} GHz", row.text("material"), row.text("frequency_GHz")),
                materials::normal_reflectivity(
                    permittivity(row.text("material"), row.number("frequency_GHz") * 1e9)),
                row.number("normal_reflectivity"));
  return section;
}

}  // namespace

std::vector<Section> dielectric_sections() { return {permittivities(), reflectivities()}; }

}  // namespace fanbeam::validation
