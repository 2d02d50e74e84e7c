#include "atmosphere/gas/gases.h"

#include <cmath>
#include <limits>

#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"
#include "tests/data_rows.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;

TEST_CASE("Gas attenuation meets the ITU's P.676-13 examples to all digits", "[gases]") {
  const auto rows = tests::data_rows("itu_p676_13_validation.csv");
  REQUIRE(rows.size() == 120);
  for (const auto& row : rows) {
    INFO(row.text("f_GHz") << " GHz");
    const GasAttenuation gas = gas_attenuation(row.number("f_GHz") * 1e9, row.number("p_dry_hPa"),
                                               row.number("T_K"), row.number("rho_gm3"));
    // Printed to 15 digits; 79 lines of mixed sign leave about 1e-14.
    CHECK(gas.oxygen_dB_per_km == tests::within(row.number("gamma_oxygen"), 1e-12));
    CHECK(gas.water_dB_per_km == tests::within(row.number("gamma_water"), 1e-12));
    CHECK(gas.total_dB_per_km() == tests::within(row.number("gamma_total"), 1e-12));
  }
}

TEST_CASE("Dry pressure is not total pressure: the difference is visible at 35 GHz", "[gases]") {
  const double vapour_hPa = vapour_pressure_hPa(7.5, 288.15);
  const double from_dry = gas_attenuation(35e9, 1013.25, 288.15, 7.5).total_dB_per_km();
  const double from_total =
      gas_attenuation(35e9, 1013.25 - vapour_hPa, 288.15, 7.5).total_dB_per_km();
  // Published to four digits: 0.1015 and 0.1003 dB/km.
  CHECK(from_dry == Approx(0.1015).epsilon(0.0).margin(5e-5));
  CHECK(from_total == Approx(0.1003).epsilon(0.0).margin(5e-5));
}

TEST_CASE("No air attenuates nothing, dry air has no water term", "[gases]") {
  CHECK(gas_attenuation(35e9, 0.0, 250.0, 0.0).total_dB_per_km() == 0.0);
  CHECK(gas_attenuation(60e9, 0.0, 250.0, 0.0).total_dB_per_km() == 0.0);
  CHECK(gas_attenuation(35e9, 1013.25, 288.15, 0.0).water_dB_per_km == 0.0);
}

TEST_CASE("Gas inputs outside their range are refused with the range", "[gases]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using core::ErrorClass;
  tests::check_rejected([] { gas_attenuation(0.9e9, 1013.0, 288.0, 7.5); }, ErrorClass::range,
                        "frequency = 0.9 GHz: expected 1 to 1000 GHz");
  tests::check_rejected([] { gas_attenuation(35e9, -1.0, 288.0, 7.5); }, ErrorClass::range,
                        "0 to 2000 hPa");
  tests::check_rejected([&] { gas_attenuation(35e9, 1013.0, nan, 7.5); }, ErrorClass::nonfinite,
                        "100 to 350 K");
  try {
    gas_attenuation(nan, -1.0, 0.0, HUGE_VAL);
    FAIL("accepted");
  } catch (const core::InputError& error) {
    CHECK(error.problems().size() == 4);
  }
}
