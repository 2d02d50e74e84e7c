#include "atmosphere/precipitation/rain.h"

#include <fmt/core.h>

#include <numbers>

#include "core/units.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

using atmosphere::RainCoefficients;
using atmosphere::RainLaw;
using core::radians;

double tilt_rad(const std::string& polarisation) {
  if (polarisation == "H") return 0.0;
  return polarisation == "V" ? std::numbers::pi / 2 : std::numbers::pi / 4;
}

Section itu_rain_examples() {
  Section section{"Rain: the ITU's own examples",
                  "ITU-R Study Group 3, validation examples for Recommendation P.838-3 (03/2005)",
                  "dB/km; k and alpha as in the Recommendation",
                  Section::Measure::relative,
                  4e-7,
                  "the examples print eight decimals"};
  for (const tests::DataRow& row : tests::data_rows("itu_p838_3_validation.csv")) {
    const double frequency_Hz = row.number("f_GHz") * 1e9;
    const double elevation_rad = radians(row.number("elevation_deg"));
    const double tau_rad = radians(row.number("tau_deg"));
    const RainCoefficients ours =
        atmosphere::rain_coefficients(frequency_Hz, elevation_rad, tau_rad);
    const std::string at = fmt::format("{} GHz, {} deg, {} mm/h", row.text("f_GHz"),
                                       row.text("elevation_deg"), row.text("rain_mm_h"));
    section.add(at + ", k", ours.k, row.number("k"));
    section.add(at + ", alpha", ours.alpha, row.number("alpha"));
    section.add(at,
                atmosphere::rain_attenuation_dB_per_km(RainLaw::itu_p838, row.number("rain_mm_h"),
                                                       frequency_Hz, elevation_rad, tau_rad),
                row.number("gamma_dB_km"));
  }
  return section;
}

Section coefficients() {
  Section section{"Rain: k and alpha from 1 to 100 GHz",
                  "regression of P.838-3, Tables 1 to 4, evaluated by another program",
                  "",
                  Section::Measure::relative,
                  5e-6,
                  "six digits are printed"};
  for (const tests::DataRow& row : tests::data_rows("itu_p838_k_alpha.csv")) {
    const double frequency_Hz = row.number("frequency_GHz") * 1e9;
    const RainCoefficients h = atmosphere::rain_coefficients(frequency_Hz, 0.0, tilt_rad("H"));
    const RainCoefficients v = atmosphere::rain_coefficients(frequency_Hz, 0.0, tilt_rad("V"));
    const std::string at = row.text("frequency_GHz") + " GHz, ";
    section.add(at + "k H", h.k, row.number("kH"));
    section.add(at + "alpha H", h.alpha, row.number("alphaH"));
    section.add(at + "k V", v.k, row.number("kV"));
    section.add(at + "alpha V", v.alpha, row.number("alphaV"));
  }
  return section;
}

Section attenuation(const std::string& model, RainLaw law, const std::string& source) {
  Section section{"Rain: " + model,           source, "dB/km",
                  Section::Measure::relative, 6e-10,  "ten digits are printed"};
  for (const tests::DataRow& row : tests::data_rows("atmosphere.csv"))
    if (row.text("model") == model)
      section.add(fmt::format("{} GHz, {} mm/h {}", row.text("frequency_GHz"),
                              row.text("rain_mm_h"), row.text("polarisation")),
                  atmosphere::rain_attenuation_dB_per_km(law, row.number("rain_mm_h"),
                                                         row.number("frequency_GHz") * 1e9, 0.0,
                                                         tilt_rad(row.text("polarisation"))),
                  row.number("value_dB_km"));
  return section;
}

}  // namespace

std::vector<Section> rain_sections() {
  return {itu_rain_examples(), coefficients(),
          attenuation("itu-r-p838-3-rain", RainLaw::itu_p838,
                      "P.838-3 as ITU-Rpy (commit 6d7f35c) evaluates it"),
          attenuation("rain-1.6-r-0.64-w-band", RainLaw::georgia_tech_95,
                      "1.6 r^0.64, Georgia Tech 1975, closed form")};
}

}  // namespace fanbeam::validation
