// Every row of the one-way reference table (tests/data/atmosphere.csv).
#include <map>

#include "atmosphere/fog/fog.h"
#include "atmosphere/gas/gases.h"
#include "atmosphere/precipitation/rain.h"
#include "atmosphere/precipitation/snow.h"
#include "core/constants.h"
#include "tests/atmosphere/within.h"
#include "tests/data_rows.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using fanbeam::tests::DataRow;

namespace {

double tilt_rad(const std::string& polarisation) {
  if (polarisation == "H") return 0.0;
  return polarisation == "V" ? core::kPi / 2 : core::kPi / 4;
}

GasAttenuation gas(const DataRow& row) {
  return gas_attenuation(row.number("frequency_GHz") * 1e9, row.number("pressure_hPa"),
                         row.number("temperature_C") + 273.15, row.number("vapour_density_gm3"));
}

double rain(const DataRow& row, RainLaw law) {
  return rain_attenuation_dB_per_km(law, row.number("rain_mm_h"), row.number("frequency_GHz") * 1e9,
                                    0.0, tilt_rad(row.text("polarisation")));
}

double fog(const DataRow& row, FogLaw law) {
  const double temperature_C = row.has("temperature_C") ? row.number("temperature_C") : 10.0;
  return fog_attenuation_dB_per_km(law, row.number("liquid_gm3"), row.number("frequency_GHz") * 1e9,
                                   temperature_C);
}

double computed(const DataRow& row) {
  const std::string& model = row.text("model");
  if (model == "itu-r-p676-13-gas-total") return gas(row).total_dB_per_km();
  if (model == "itu-r-p676-13-oxygen") return gas(row).oxygen_dB_per_km;
  if (model == "itu-r-p676-13-water-vapour") return gas(row).water_dB_per_km;
  if (model == "itu-r-p838-3-rain") return rain(row, RainLaw::itu_p838);
  if (model == "rain-1.6-r-0.64-w-band") return rain(row, RainLaw::georgia_tech_95);
  if (model == "itu-r-p840-liquid") return fog(row, FogLaw::itu_p840);
  if (model == "altshuler-1984-fog") return fog(row, FogLaw::altshuler);
  if (model == "centimetre-fog-0.438") return fog(row, FogLaw::centimetre);
  if (model == "gunn-east-1954-dry-snow")
    return snow_attenuation_dB_per_km(row.number("rain_mm_h"), row.number("frequency_GHz") * 1e9);
  FAIL("no model for " << model);
  return 0.0;
}

}  // namespace

TEST_CASE("Every one-way reference value is met to its ten printed digits", "[atmosphere_rows]") {
  std::map<std::string, int> count;
  for (const DataRow& row : tests::data_rows("atmosphere.csv")) {
    const std::string& model = row.text("model");
    ++count[model];
    INFO(model << " at " << row.text("frequency_GHz") << " GHz");
    // Ten significant digits are printed: half a unit of the last is up to 5e-10.
    CHECK(computed(row) == tests::within(row.number("value_dB_km"), 6e-10));
  }
  CHECK(count["gunn-east-1954-dry-snow"] == 3);
  CHECK(count["itu-r-p676-13-gas-total"] == 18);
  CHECK(count["itu-r-p838-3-rain"] == 23);
  CHECK(count["itu-r-p840-liquid"] == 18);
  CHECK(count.size() == 9);
}
