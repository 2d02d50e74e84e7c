#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "atmosphere/precipitation/drop_scattering.h"
#include "atmosphere/precipitation/rain_echo.h"
#include "atmosphere/precipitation/snow.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

using atmosphere::DropScattering;
using atmosphere::DropSizes;

DropSizes sizes_of(const std::string& law) {
  if (law == "MP") return DropSizes::marshall_palmer;
  return law == "JD" ? DropSizes::joss_drizzle : DropSizes::joss_thunderstorm;
}

// One integration table per frequency and temperature.
const DropScattering& drops(double frequency_GHz, double temperature_C) {
  static std::map<std::pair<double, double>, DropScattering> known;
  const std::pair<double, double> key(frequency_GHz, temperature_C);
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, DropScattering(frequency_GHz * 1e9, temperature_C)).first->second;
}

const char* const kMieSource =
    "Mie integration over drop sizes by another program, computed for this project; permittivity "
    "of "
    "ITU-R P.840, drop sizes of Marshall and Palmer 1948 (MP), Joss drizzle (JD) and thunderstorm "
    "(JT) 1968";

std::string conditions(const tests::DataRow& row) {
  return fmt::format("{} GHz, {} C, {}, {} mm/h", row.text("frequency_GHz"),
                     row.text("temperature_C"), row.text("dsd"), row.text("rain_mm_h"));
}

Section mie(bool echo) {
  Section section{echo ? "Rain: echo by Mie scattering" : "Rain: attenuation by Mie scattering",
                  kMieSource,
                  echo ? "m2/m3" : "dB/km",
                  Section::Measure::relative,
                  1e-3,
                  "five digits are printed and the integration steps differ; two correct codes "
                  "are expected to agree within 1 %"};
  for (const tests::DataRow& row : tests::data_rows("rain_mie.csv")) {
    const DropScattering& scattering =
        drops(row.number("frequency_GHz"), row.number("temperature_C"));
    const DropSizes sizes = sizes_of(row.text("dsd"));
    const double rate_mm_per_h = row.number("rain_mm_h");
    section.add(conditions(row),
                echo ? scattering.eta_m2_per_m3(sizes, rate_mm_per_h)
                     : scattering.attenuation_dB_per_km(sizes, rate_mm_per_h),
                row.number(echo ? "eta_m2_m3" : "attenuation_dB_km"));
  }
  return section;
}

// How far the published fits leave our own integration, against how far they say they leave theirs.
Section fits() {
  Section section{"Rain: what the published fits of the echo miss",
                  "quadratic and power-law fits to the same integration, 0.5 to 100 mm/h, "
                  "Marshall-Palmer, 10 C; computed for this project",
                  "dB, largest deviation",
                  Section::Measure::difference,
                  0.03,
                  "two decimals are printed, and the fits' worst rain rates are not in the table"};
  for (const tests::DataRow& fit : tests::data_rows("rain_eta_fits.csv")) {
    double quadratic_dB = 0.0;
    for (const tests::DataRow& row : tests::data_rows("rain_mie.csv")) {
      if (row.text("dsd") != "MP" || row.number("temperature_C") != 10.0 ||
          row.number("frequency_GHz") != fit.number("frequency_GHz"))
        continue;
      const double x = std::log10(row.number("rain_mm_h"));
      const double level = fit.number("q0") + x * (fit.number("q1") + x * fit.number("q2"));
      const double ours = drops(fit.number("frequency_GHz"), 10.0)
                              .eta_m2_per_m3(DropSizes::marshall_palmer, row.number("rain_mm_h"));
      quadratic_dB = std::max(quadratic_dB, std::abs(10.0 * (level - std::log10(ours))));
    }
    section.add(fit.text("frequency_GHz") + " GHz, quadratic", quadratic_dB,
                fit.number("quad_max_dB"));
  }
  return section;
}

Section dry_snow() {
  Section section{"Snow: attenuation of dry snow",
                  "Gunn and East 1954, Quart. J. Royal Met. Soc. 80, 522; closed form",
                  "dB/km",
                  Section::Measure::relative,
                  6e-10,
                  "ten digits are printed"};
  for (const tests::DataRow& row : tests::data_rows("atmosphere.csv"))
    if (row.text("model") == "gunn-east-1954-dry-snow")
      section.add(fmt::format("{} GHz, {} mm/h", row.text("frequency_GHz"), row.text("rain_mm_h")),
                  atmosphere::snow_attenuation_dB_per_km(row.number("rain_mm_h"),
                                                         row.number("frequency_GHz") * 1e9),
                  row.number("value_dB_km"));
  return section;
}

}  // namespace

std::vector<Section> precipitation_sections() {
  return {mie(false), mie(true), fits(), dry_snow()};
}

}  // namespace fanbeam::validation
