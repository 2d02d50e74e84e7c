#include "atmosphere/gas/standard_atmosphere.h"

#include <cmath>

#include "atmosphere/gas/gases.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

TEST_CASE("The reference atmosphere is that of P.835-6", "[standard_atmosphere]") {
  const StandardAtmosphere reference;
  CHECK(reference.at(0.0).temperature_K == 288.15);
  CHECK(reference.at(0.0).pressure_hPa == 1013.25);
  CHECK(reference.at(0.0).vapour_density_g_per_m3 == 7.5);
  CHECK(reference.at(2000.0).vapour_density_g_per_m3 == tests::within(7.5 / std::exp(1.0), 1e-14));
  // Geopotential 11 km lies at 11019.07 m; 226.3226 hPa there (P.835-6 equation 2b), where equation 2a ends with
  // 226.3206: they meet to 9e-6.
  const double tropopause_m = 6356766.0 * 11.0 / (6356.766 - 11.0);
  CHECK(reference.at(tropopause_m).temperature_K == Approx(216.65).epsilon(0.0).margin(1e-9));
  CHECK(reference.at(tropopause_m).pressure_hPa == Approx(226.3226).epsilon(1e-5));
  // 54.74898 hPa at geopotential 20 km (P.835-6 equation 2c) continues the isothermal layer.
  const double h18_m = 6356766.0 * 18.0 / (6356.766 - 18.0);
  CHECK(reference.at(h18_m).pressure_hPa ==
        Approx(226.3226 * std::exp(-34.1632 * 7.0 / 216.65)).epsilon(1e-5));
}

TEST_CASE("Total gas loss over height has the published values", "[standard_atmosphere]") {
  struct Column {
    double frequency_Hz;
    double at_km[4];
    double margin;
  };
  // Four or three digits are printed, worked out from states of the air that were rounded too:
  // 35 GHz at 3 km is 0.03025 here and 0.0303 there.
  for (const Column& column : {Column{35e9, {0.1003, 0.0644, 0.0432, 0.0303}, 6e-5},
                               Column{76.5e9, {0.347, 0.221, 0.148, 0.104}, 5.1e-4},
                               Column{94e9, {0.404, 0.234, 0.139, 0.085}, 5.1e-4}})
    for (int h_km = 0; h_km <= 3; ++h_km) {
      const AirState air = StandardAtmosphere().at(1000.0 * h_km);
      const GasAttenuation gas = gas_attenuation(column.frequency_Hz, air.dry_pressure_hPa(),
                                                 air.temperature_K, air.vapour_density_g_per_m3);
      CHECK(gas.total_dB_per_km() == Approx(column.at_km[h_km]).epsilon(0.0).margin(column.margin));
    }
}

TEST_CASE("Surface values are met at their height and keep the lapse rate",
          "[standard_atmosphere]") {
  const StandardAtmosphere air({1500.0, -5.0, 850.0, 0.5});
  const AirState surface = air.at(1500.0);
  CHECK(surface.temperature_K == tests::within(268.15, 1e-14));
  CHECK(surface.pressure_hPa == tests::within(850.0, 1e-14));
  CHECK(surface.vapour_density_g_per_m3 ==
        tests::within(0.5 * saturation_vapour_density_g_per_m3(268.15, 850.0), 1e-12));
  const StandardAtmosphere reference;
  CHECK(air.at(4000.0).temperature_K - surface.temperature_K ==
        Approx(reference.at(4000.0).temperature_K - reference.at(1500.0).temperature_K));
  // Colder air is denser: pressure falls faster than in the reference.
  CHECK(air.at(4000.0).pressure_hPa / surface.pressure_hPa <
        reference.at(4000.0).pressure_hPa / reference.at(1500.0).pressure_hPa);
}

TEST_CASE("Naming the reference's own surface values changes nothing", "[standard_atmosphere]") {
  const StandardAtmosphere reference;
  const AirState there = reference.at(581.0);
  const StandardAtmosphere named(
      {581.0, there.temperature_K - 273.15, there.pressure_hPa, std::nullopt});
  for (const double height_m : {-400.0, 0.0, 581.0, 3000.0, 15000.0}) {
    CHECK(named.at(height_m).temperature_K ==
          tests::within(reference.at(height_m).temperature_K, 1e-13));
    CHECK(named.at(height_m).pressure_hPa ==
          tests::within(reference.at(height_m).pressure_hPa, 1e-12));
    CHECK(named.at(height_m).vapour_density_g_per_m3 ==
          tests::within(reference.at(height_m).vapour_density_g_per_m3, 1e-12));
  }
}

TEST_CASE("Saturated air has the published vapour density and is never exceeded",
          "[standard_atmosphere]") {
  CHECK(saturation_vapour_density_g_per_m3(273.15, 1013.25) ==
        Approx(4.9).epsilon(0.0).margin(0.05));
  CHECK(saturation_vapour_density_g_per_m3(283.15, 1013.25) ==
        Approx(9.4).epsilon(0.0).margin(0.05));
  CHECK(saturation_vapour_density_g_per_m3(293.15, 1013.25) ==
        Approx(17.4).epsilon(0.0).margin(0.051));
  const StandardAtmosphere humid({0.0, 20.0, std::nullopt, 1.0});
  const StandardAtmosphere frosty({0.0, -20.0, std::nullopt, std::nullopt});
  for (double height_m = -2000.0; height_m <= 12000.0; height_m += 500.0)
    for (const StandardAtmosphere* air : {&humid, &frosty}) {
      const AirState state = air->at(height_m);
      CHECK(state.vapour_density_g_per_m3 <=
            saturation_vapour_density_g_per_m3(state.temperature_K, state.pressure_hPa));
      CHECK(state.dry_pressure_hPa() > 0.0);
    }
}

TEST_CASE("The extremes that are accepted stay inside the gas model's range",
          "[standard_atmosphere]") {
  for (const double origin_m : {-500.0, 6000.0})
    for (const double temperature_C : {-60.0, 50.0})
      for (const double pressure_hPa : {300.0, 1100.0})
        for (const double humidity : {0.0, 1.0})
          for (const double height_m : {-2000.0, 0.0, 12000.0}) {
            const AirState air =
                StandardAtmosphere({origin_m, temperature_C, pressure_hPa, humidity})
                    .at(origin_m + height_m);
            CHECK(std::isfinite(gas_attenuation(35e9, air.dry_pressure_hPa(), air.temperature_K,
                                                air.vapour_density_g_per_m3)
                                    .total_dB_per_km()));
          }
}

TEST_CASE("Impossible air is refused, all problems together", "[standard_atmosphere]") {
  tests::check_rejected([] { StandardAtmosphere().at(20001.0); }, ErrorClass::range,
                        "-3000 to 20000 m");
  tests::check_rejected([] { StandardAtmosphere().at(std::nan("")); }, ErrorClass::nonfinite,
                        "height_m");
  try {
    StandardAtmosphere({9000.0, -300.0, std::nan(""), 1.5});
    FAIL("accepted");
  } catch (const core::InputError& error) {
    CHECK(error.problems().size() == 4);
    CHECK_THAT(error.what(), Catch::Contains("humidity = 1.5: expected 0 to 1"));
  }
}
