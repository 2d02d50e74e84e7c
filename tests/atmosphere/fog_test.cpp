#include "atmosphere/fog/fog.h"

#include <array>
#include <cmath>

#include "atmosphere/fog/fog_water.h"
#include "core/constants.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

namespace {

constexpr double frequency_Hz(double wavelength_m) {
  return core::kSpeedOfLight_mps / wavelength_m;
}

}  // namespace

TEST_CASE("P.840 liquid-water coefficient falls with temperature at 35 GHz", "[fog]") {
  // Recommendation ITU-R P.840-8 evaluated; four digits.
  constexpr std::array<std::array<double, 2>, 5> kPublished = {
      {{-8.0, 1.237}, {0.0, 1.019}, {10.0, 0.794}, {20.0, 0.634}, {25.0, 0.573}}};
  for (const auto& [temperature_C, coefficient] : kPublished)
    CHECK(fog_coefficient(FogLaw::itu_p840, 35e9, temperature_C) ==
          Approx(coefficient).epsilon(0.0).margin(5.1e-4));
}

TEST_CASE("Altshuler's law is positive wherever it is accepted", "[fog]") {
  for (int step = 0; step <= 70; ++step) {
    const double wavelength_m = 0.003 + 1e-4 * step;
    for (double temperature_C = -8.0; temperature_C <= 25.0; temperature_C += 0.5) {
      const double f_Hz = std::fmax(frequency_Hz(wavelength_m), frequency_Hz(0.010));
      const double altshuler = fog_coefficient(FogLaw::altshuler, f_Hz, temperature_C);
      REQUIRE(altshuler > 0.27);
      if (wavelength_m < 0.0086)
        REQUIRE(altshuler ==
                Approx(fog_coefficient(FogLaw::itu_p840, f_Hz, temperature_C)).epsilon(0.19));
    }
  }
}

TEST_CASE("Fog laws accept their own wavelengths and temperatures, borders included", "[fog]") {
  const auto coefficient = [](FogLaw law, double wavelength_m, double temperature_C) {
    return fog_coefficient(law, frequency_Hz(wavelength_m), temperature_C);
  };
  CHECK(coefficient(FogLaw::altshuler, 0.003, -8.0) > 0.0);
  CHECK(coefficient(FogLaw::altshuler, 0.010, 25.0) > 0.0);
  CHECK(coefficient(FogLaw::centimetre, 0.02, 10.0) == tests::within(0.438 / 4.0, 1e-14));
  CHECK(coefficient(FogLaw::centimetre, 0.10, 10.0) == tests::within(0.438 / 100.0, 1e-14));

  // At 30 mm and 20 C the formula gives -0.07: published range, refused here.
  tests::check_rejected([&] { coefficient(FogLaw::altshuler, 0.030, 20.0); }, ErrorClass::range,
                        "30 to 100 GHz for the fog law altshuler");
  tests::check_rejected([&] { coefficient(FogLaw::altshuler, 0.00857, 25.1); }, ErrorClass::range,
                        "-8 to 25 C");
  tests::check_rejected([&] { coefficient(FogLaw::centimetre, 0.00857, 10.0); }, ErrorClass::range,
                        "3 to 15 GHz for the fog law centimetre");
  tests::check_rejected([] { fog_coefficient(FogLaw::itu_p840, 201e9, 10.0); }, ErrorClass::range,
                        "frequency = 201 GHz: expected 1 to 200 GHz for the fog law itu-p840");
  tests::check_rejected([] { fog_coefficient(FogLaw::itu_p840, 35e9, -41.0); }, ErrorClass::range,
                        "-40 to 50 C where there is fog");
}

TEST_CASE("Round frequencies of the fog laws' round wavelengths are inside, and told in GHz",
          "[fog]") {
  // 2 and 10 cm, 3 and 10 mm with c = 3e8 m/s.
  CHECK(fog_coefficient(FogLaw::centimetre, 15e9, 10.0) ==
        tests::within(0.438 / (1.9986163867 * 1.9986163867), 1e-9));
  CHECK(fog_coefficient(FogLaw::centimetre, 3e9, 10.0) > 0.0);
  CHECK(fog_coefficient(FogLaw::altshuler, 30e9, 25.0) > 0.0);
  CHECK(fog_coefficient(FogLaw::altshuler, 100e9, 10.0) > 0.0);
  const auto refused = [](FogLaw law, double f_Hz, const std::string& text) {
    tests::check_rejected([&] { fog_coefficient(law, f_Hz, 10.0); }, ErrorClass::range, text);
  };
  const std::string centimetre = " GHz: expected 3 to 15 GHz for the fog law centimetre";
  refused(FogLaw::centimetre, 15.01e9, "frequency = 15.01" + centimetre);
  refused(FogLaw::centimetre, 2.99e9, "frequency = 2.99" + centimetre);
  const std::string altshuler = " GHz: expected 30 to 100 GHz for the fog law altshuler";
  refused(FogLaw::altshuler, 100.1e9, "frequency = 100.1" + altshuler);
  refused(FogLaw::altshuler, 29.9e9, "frequency = 29.9" + altshuler);
}

TEST_CASE("No fog water is no loss, impossible fog water is refused", "[fog]") {
  const auto loss = [](double liquid_water) {
    return fog_attenuation_dB_per_km(FogLaw::itu_p840, liquid_water, 35e9, 10.0);
  };
  CHECK(loss(0.0) == 0.0);
  CHECK(loss(0.1) == Approx(0.0794).epsilon(0.0).margin(5e-5));
  tests::check_rejected([&] { loss(-0.1); }, ErrorClass::range, "0 to 20 g/m3");
  tests::check_rejected([&] { loss(std::nan("")); }, ErrorClass::nonfinite, "0 to 20 g/m3");
}

TEST_CASE("Water content from visibility follows each named model", "[fog][fog_water]") {
  struct Published {
    FogWaterModel model;
    std::array<double, 4> liquid_water_g_per_m3;  // at 50, 100, 300, 1000 m, as printed
    std::array<double, 4> half_digit;
  };
  const std::array<Published, 4> published = {{
      {FogWaterModel::kunkel, {0.497, 0.226, 0.065, 0.0165}, {5e-4, 5e-4, 5e-4, 5e-5}},
      {FogWaterModel::eldridge_altshuler, {0.323, 0.111, 0.0205, 0.0032}, {5e-4, 5e-4, 5e-5, 5e-5}},
      {FogWaterModel::zhao_radiation, {0.319, 0.110, 0.0202, 0.0032}, {5e-4, 5e-4, 5e-5, 5e-5}},
      {FogWaterModel::zhao_advection, {1.131, 0.420, 0.087, 0.0156}, {5e-4, 5e-4, 5e-4, 5e-5}},
  }};
  constexpr std::array kVisibility_m = {50.0, 100.0, 300.0, 1000.0};
  for (const Published& row : published)
    for (std::size_t i = 0; i < kVisibility_m.size(); ++i) {
      INFO(name_of(row.model) << " at " << kVisibility_m[i] << " m");
      CHECK(liquid_water_g_per_m3(row.model, kVisibility_m[i]) ==
            Approx(row.liquid_water_g_per_m3[i]).epsilon(0.0).margin(1.05 * row.half_digit[i]));
    }
  // V = b M^(-2/3) turned around: at V = b the water content is 1 g/m3.
  CHECK(liquid_water_g_per_m3(FogWaterModel::tomasi_dry_cold, 34.0) == tests::within(1.0, 1e-14));
  CHECK(liquid_water_g_per_m3(FogWaterModel::tomasi_wet_warm, 240.0) ==
        tests::within(1.0 / 8.0, 1e-14));
}

TEST_CASE("Only Kunkel's water content meets both anchors of P.840", "[fog][fog_water]") {
  // About 0.05 g/m3 at 300 m and 0.5 g/m3 at 50 m; "about" read as 35 %.
  CHECK(liquid_water_g_per_m3(FogWaterModel::kunkel, 300.0) == Approx(0.05).epsilon(0.35));
  CHECK(liquid_water_g_per_m3(FogWaterModel::kunkel, 50.0) == Approx(0.5).epsilon(0.35));
}

TEST_CASE("Visibility outside 10 m to 100 km is refused", "[fog][fog_water]") {
  const auto water = [](double visibility_m) {
    return liquid_water_g_per_m3(FogWaterModel::zhao_advection, visibility_m);
  };
  CHECK(water(10.0) < kLargestLiquidWater_g_per_m3);
  CHECK(water(1e5) > 0.0);
  tests::check_rejected([&] { water(0.0); }, ErrorClass::range, "10 to 100000 m");
  tests::check_rejected([&] { water(-3.0); }, ErrorClass::range, "10 to 100000 m");
  tests::check_rejected([&] { water(HUGE_VAL); }, ErrorClass::nonfinite, "10 to 100000 m");
}

TEST_CASE("Fog laws and fog types have names", "[fog][fog_water]") {
  for (const FogLaw law : {FogLaw::itu_p840, FogLaw::altshuler, FogLaw::centimetre})
    CHECK(fog_law_named(name_of(law)) == law);
  for (const char* name : {"kunkel", "eldridge-altshuler", "zhao-radiation", "zhao-advection",
                           "tomasi-dry-cold", "tomasi-wet-warm"})
    CHECK(name_of(fog_water_model_named(name)) == name);
  tests::check_rejected([] { fog_law_named(""); }, ErrorClass::ref, "one of itu-p840, altshuler");
  tests::check_rejected([] { fog_water_model_named("Kunkel"); }, ErrorClass::ref, "one of kunkel");
}
