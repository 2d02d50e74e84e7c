#include "atmosphere/precipitation/snow.h"

#include <cmath>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/precipitation/melting_layer.h"
#include "atmosphere/volume_echo.h"
#include "core/constants.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

TEST_CASE("Dry snow follows Gunn and East", "[snow]") {
  // 0.00349 r^1.6 / L^4 + 0.00224 r / L at 35 GHz: 0.070 dB/km at 4 mm/h, 0.284 at 10.
  CHECK(snow_attenuation_dB_per_km(4.0, 35e9) == Approx(0.0700).epsilon(2e-3));
  CHECK(snow_attenuation_dB_per_km(10.0, 35e9) == tests::within(0.2842673457, 1e-9));
  CHECK(snow_attenuation_dB_per_km(0.0, 35e9) == 0.0);
  tests::check_rejected([] { snow_attenuation_dB_per_km(4.0, 76.5e9); }, ErrorClass::range,
                        "for the loss in dry snow");
  tests::check_rejected([] { snow_attenuation_dB_per_km(51.0, 35e9); }, ErrorClass::range,
                        "0 to 50");
}

TEST_CASE("The echo of dry snow is Sekhon and Srivastava's Z with the dielectric factor of ice",
          "[snow]") {
  const double wavelength_m = core::kSpeedOfLight_mps / 10e9;
  // Equivalent reflectivity, which assumes water: Ze = 0.208/0.93 1780 R^2.21 = 26.0 dBZ at 1 mm/h.
  const double ze = snow_eta_m2_per_m3(1.0, 10e9) * 1e18 * std::pow(wavelength_m, 4.0) /
                    (std::pow(core::kPi, 5.0) * 0.93);
  CHECK(10.0 * std::log10(ze) == Approx(26.0).epsilon(0.0).margin(0.01));
  CHECK(snow_eta_m2_per_m3(2.0, 35e9) / snow_eta_m2_per_m3(1.0, 35e9) ==
        tests::within(std::pow(2.0, 2.21), 1e-12));
  CHECK(snow_eta_m2_per_m3(0.0, 35e9) == 0.0);
  tests::check_rejected([] { snow_eta_m2_per_m3(1.0, 50e9); }, ErrorClass::range,
                        "for the echo of dry snow");
}

TEST_CASE("The melting layer attenuates up to 3.5 times its rain", "[melting]") {
  CHECK(melting_multiple(0.1) == 0.0);
  CHECK(melting_multiple(0.0) == 0.0);
  CHECK(melting_multiple(-1200.1) == 1.0);
  CHECK(melting_multiple(-1200.0) == Approx(1.028).epsilon(0.0).margin(1e-3));
  // By hand at -360 m, the 0 C level: g = 0.994165, s = 0.302324, 4 g^2 = 3.953456.
  CHECK(melting_multiple(-360.0) == Approx(3.953456 / (1.0 + 0.091400 * 2.953456)).epsilon(1e-5));
  double peak = 0.0;
  for (double d = 0.0; d >= -1300.0; d -= 0.5) peak = std::max(peak, melting_multiple(d));
  CHECK(peak == Approx(3.5328).epsilon(0.0).margin(1e-4));
  CHECK(largest_melting_multiple(-2000.0, 500.0) >= peak);
  for (const double low : {-1300.0, -900.0, -240.0, -100.0})
    for (const double high : {-1250.0, -700.0, -239.0, -10.0, 30.0}) {
      if (high < low) continue;
      double most = 0.0;
      for (double d = low; d <= high; d += 0.25) most = std::max(most, melting_multiple(d));
      CHECK(largest_melting_multiple(low, high) >= most);
      CHECK(largest_melting_multiple(low, high) <= most * (1.0 + 1e-3) + 1e-3);
    }
}

TEST_CASE("Rain below, melting layer, dry snow above", "[melting][path_attenuation]") {
  Weather weather;
  weather.simulate_gas = false;
  weather.rain_rate_mm_per_h = 5.0;
  weather.snow_rate_mm_per_h = 5.0;
  weather.melting_height_m = 1000.0;
  weather.snow_top_m = 4000.0;
  const double rain = rain_dB_per_km(weather, 5.0, 35e9);
  const double snow = snow_attenuation_dB_per_km(5.0, 35e9);
  const PathAttenuation path(weather, 35e9);
  const double rain_height_m = 1360.0;
  CHECK(path.one_way_attenuation_dB_per_km(100.0).rain_dB_per_km == rain);
  CHECK(path.one_way_attenuation_dB_per_km(100.0).snow_dB_per_km == 0.0);
  for (double height_m = 161.0; height_m < rain_height_m; height_m += 7.3)
    CHECK(path.one_way_attenuation_dB_per_km(height_m).rain_dB_per_km ==
          Approx(rain * melting_multiple(height_m - rain_height_m)).epsilon(1e-4).margin(2e-3));
  CHECK(path.one_way_attenuation_dB_per_km(rain_height_m).rain_dB_per_km == 0.0);
  CHECK(path.one_way_attenuation_dB_per_km(rain_height_m).snow_dB_per_km == snow);
  CHECK(path.one_way_attenuation_dB_per_km(4000.0).total_dB_per_km() == 0.0);

  // Straight up: the integral of the profile, here with Simpson's rule in 1 m.
  double melting = 0.0;
  for (int i = 0; i <= 1200; ++i)
    melting += melting_multiple(-1200.0 + i) *
               (i == 0 || i == 1200 ? 1.0
                : i % 2 == 1        ? 4.0
                                    : 2.0) /
               3.0;
  const double expected = 1e-3 * (rain * (160.0 + melting) + snow * (4000.0 - rain_height_m));
  CHECK(path.one_way_dB(0.0, 5000.0, 5000.0) == tests::within(expected, 2e-5));

  // Each cause can be switched off alone.
  Weather no_snow = weather;
  no_snow.simulate_snow = false;
  Weather no_rain = weather;
  no_rain.simulate_rain = false;
  CHECK(PathAttenuation(no_snow, 35e9).one_way_dB(1500.0, 3000.0, 2000.0) == 0.0);
  CHECK(PathAttenuation(no_rain, 35e9).one_way_dB(0.0, 1200.0, 2000.0) == 0.0);
  no_rain.simulate_snow = false;
  CHECK(PathAttenuation(no_rain, 35e9).is_clear());

  const VolumeEcho echo(weather, 35e9);
  const double rain_eta = rain_eta_m2_per_m3(RainEchoLaw::mie, 5.0, 35e9, rain_drops(weather));
  CHECK(echo.layered_eta_m2_per_m3(100.0) == rain_eta);
  CHECK(echo.layered_eta_m2_per_m3(rain_height_m - 300.0) ==
        tests::within(rain_eta * melting_multiple(-300.0), 1e-12));
  CHECK(echo.layered_eta_m2_per_m3(rain_height_m) == snow_eta_m2_per_m3(5.0, 35e9));
  CHECK(echo.layered_eta_m2_per_m3(4000.0) == 0.0);
  CHECK(echo.same_at_all_heights(-500.0, rain_height_m - kMeltingDepth_m));
  CHECK_FALSE(echo.same_at_all_heights(-500.0, rain_height_m - kMeltingDepth_m + 1.0));
  CHECK_FALSE(echo.same_at_all_heights(rain_height_m - 1.0, rain_height_m));
  CHECK(echo.same_at_all_heights(rain_height_m, 3999.0));
  CHECK_FALSE(echo.same_at_all_heights(rain_height_m, 4000.0));
  CHECK(echo.largest_eta_m2_per_m3(-100.0, 100.0) == rain_eta);
  for (double h = -500.0; h < 5000.0; h += 1.0)
    REQUIRE(echo.layered_eta_m2_per_m3(h) <= echo.largest_eta_m2_per_m3());
}

TEST_CASE("The 0 C level comes from the air", "[melting]") {
  Weather weather;
  weather.rain_rate_mm_per_h = 4.0;
  weather.melting_layer = true;
  weather.temperature_C = 13.0;
  // 13 C at 6.5 K per geopotential km: 2000 m, plus 360 m.
  CHECK(precipitation_layers(weather).rain_top_m == Approx(2360.0).epsilon(0.0).margin(1.0));
  weather.temperature_C = -60.0;
  weather.rain_rate_mm_per_h = 0.0;
  tests::check_rejected([&] { PathAttenuation(weather, 35e9); }, ErrorClass::range, "no 0 C level");
}

TEST_CASE("Snow that cannot be is refused, snow in warm air is told", "[snow]") {
  Weather weather;
  weather.snow_rate_mm_per_h = 3.0;
  weather.temperature_C = -4.0;
  CHECK(problems_in(weather, 35e9).all().empty());
  CHECK_FALSE(PathAttenuation(weather, 35e9).is_clear());
  weather.temperature_C = 12.0;
  REQUIRE(problems_in(weather, 35e9).all().size() == 1);
  CHECK(problems_in(weather, 35e9).all().front().code == "W-WARM-SNOW");
  weather.rain_rate_mm_per_h = 3.0;
  tests::check_rejected([&] { PathAttenuation(weather, 35e9); }, ErrorClass::range,
                        "a melting layer between rain and snow");
  weather.rain_rate_mm_per_h = 0.0;
  const core::ProblemList at_94 = problems_in(weather, 94e9);
  CHECK(at_94.has_errors());
}
