#include <fmt/core.h>

#include "atmosphere/gas/gases.h"
#include "atmosphere/path_attenuation.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

using atmosphere::GasAttenuation;

Section itu_gas_examples() {
  Section section{"Gas: the ITU's own examples",
                  "ITU-R Study Group 3, validation examples for Recommendation P.676-13 (08/2022), "
                  "specific attenuation, rows up to 120 GHz",
                  "dB/km",
                  Section::Measure::relative,
                  1e-9,
                  "all printed digits count"};
  for (const tests::DataRow& row : tests::data_rows("itu_p676_13_validation.csv")) {
    const GasAttenuation gas =
        atmosphere::gas_attenuation(row.number("f_GHz") * 1e9, row.number("p_dry_hPa"),
                                    row.number("T_K"), row.number("rho_gm3"));
    section.add(row.text("f_GHz") + " GHz, oxygen", gas.oxygen_dB_per_km,
                row.number("gamma_oxygen"));
    section.add(row.text("f_GHz") + " GHz, water vapour", gas.water_dB_per_km,
                row.number("gamma_water"));
  }
  return section;
}

Section other_air() {
  Section section{"Gas: other temperatures, pressures and humidities",
                  "P.676-13 Annex 1 as ITU-Rpy (commit 6d7f35c) evaluates it",
                  "dB/km",
                  Section::Measure::relative,
                  6e-10,
                  "ten digits are printed"};
  for (const tests::DataRow& row : tests::data_rows("atmosphere.csv")) {
    const std::string& model = row.text("model");
    if (!model.starts_with("itu-r-p676")) continue;
    const GasAttenuation gas = atmosphere::gas_attenuation(
        row.number("frequency_GHz") * 1e9, row.number("pressure_hPa"),
        row.number("temperature_C") + 273.15, row.number("vapour_density_gm3"));
    const double ours = model.ends_with("total")    ? gas.total_dB_per_km()
                        : model.ends_with("oxygen") ? gas.oxygen_dB_per_km
                                                    : gas.water_dB_per_km;
    section.add(fmt::format("{} at {} GHz, {} C, {} hPa, {} g/m3", model.substr(15),
                            row.text("frequency_GHz"), row.text("temperature_C"),
                            row.text("pressure_hPa"), row.text("vapour_density_gm3")),
                ours, row.number("value_dB_km"));
  }
  return section;
}

Section slant_paths() {
  Section section{"Gas: loss along slanted paths",
                  "P.676-13 on the standard atmosphere of ITU-R P.835-6, 4000 steps; computed for "
                  "this project by another program",
                  "dB, one way",
                  Section::Measure::relative,
                  1e-4,
                  "the profile is linear within 25 m of height"};
  for (const tests::DataRow& row : tests::data_rows("gas_slant_path.csv")) {
    const atmosphere::PathAttenuation path(atmosphere::Weather{},
                                           row.number("frequency_GHz") * 1e9);
    section.add(fmt::format("{} GHz, {} km from height {} to {} km", row.text("frequency_GHz"),
                            row.text("range_km"), row.text("h1_km"), row.text("h2_km")),
                path.one_way_dB(row.number("h1_km") * 1e3, row.number("h2_km") * 1e3,
                                row.number("range_km") * 1e3),
                row.number("one_way_dB"));
  }
  return section;
}

}  // namespace

std::vector<Section> gas_sections() { return {itu_gas_examples(), other_air(), slant_paths()}; }

}  // namespace fanbeam::validation
