#include "atmosphere/fog/fog.h"

#include <fmt/core.h>

#include <cmath>

#include "atmosphere/fog/fog_water.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

Section attenuation(const std::string& model, atmosphere::FogLaw law, const std::string& source) {
  Section section{"Fog: " + model,         source, "dB/km", Section::Measure::relative, 6e-10,
                  "ten digits are printed"};
  for (const tests::DataRow& row : tests::data_rows("atmosphere.csv")) {
    if (row.text("model") != model) continue;
    // The centimetre law knows no temperature; its rows leave the column empty.
    const double temperature_C = row.has("temperature_C") ? row.number("temperature_C") : 10.0;
    section.add(
        fmt::format("{} GHz, {} C, {} g/m3", row.text("frequency_GHz"), temperature_C,
                    row.text("liquid_gm3")),
        atmosphere::fog_attenuation_dB_per_km(law, row.number("liquid_gm3"),
                                              row.number("frequency_GHz") * 1e9, temperature_C),
        row.number("value_dB_km"));
  }
  return section;
}

Section water_content() {
  Section section{"Fog: water content from visibility",
                  "the published coefficients c and n of M = (c / V)^n, evaluated here; "
                  "tests/data/fog_water_content_models.csv names each paper",
                  "g/m3",
                  Section::Measure::relative,
                  1e-5,
                  "c and n are rounded to six digits in the table"};
  for (const tests::DataRow& row : tests::data_rows("fog_water_content_models.csv"))
    for (const double visibility_m : {50.0, 100.0, 300.0, 1000.0})
      section.add(fmt::format("{}, {} m", row.text("name"), visibility_m),
                  atmosphere::liquid_water_g_per_m3(
                      atmosphere::fog_water_model_named(row.text("name")), visibility_m),
                  std::pow(row.number("c") / (visibility_m / 1000.0), row.number("n")));
  return section;
}

}  // namespace

std::vector<Section> fog_sections() {
  using atmosphere::FogLaw;
  return {attenuation("itu-r-p840-liquid", FogLaw::itu_p840,
                      "Recommendation ITU-R P.840-8 (08/2019) as ITU-Rpy (commit 6d7f35c) "
                      "evaluates it"),
          attenuation("altshuler-1984-fog", FogLaw::altshuler,
                      "Altshuler, IEEE Trans. AP 32 (1984) 757, closed form"),
          attenuation("centimetre-fog-0.438", FogLaw::centimetre,
                      "0.438 M / wavelength^2, closed form"),
          water_content()};
}

}  // namespace fanbeam::validation
