// Rain as a population of Mie spheres: attenuation and echo.
#include <cmath>

#include "atmosphere/precipitation/drop_scattering.h"
#include "atmosphere/precipitation/rain.h"
#include "atmosphere/precipitation/rain_echo.h"
#include "core/constants.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"
#include "tests/data_rows.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

namespace {

DropSizes sizes_of(const std::string& code) {
  if (code == "MP") return DropSizes::marshall_palmer;
  return code == "JD" ? DropSizes::joss_drizzle : DropSizes::joss_thunderstorm;
}

double ratio_dB(double a, double b) { return 10.0 * std::log10(a / b); }

}  // namespace

TEST_CASE("All rows of the Mie rain table are met", "[rain_scattering]") {
  const auto rows = tests::data_rows("rain_mie.csv");
  REQUIRE(rows.size() == 100);
  for (const auto& row : rows) {
    const double frequency_Hz = row.number("frequency_GHz") * 1e9;
    const double rate_mm_per_h = row.number("rain_mm_h");
    const RainDrops drops{sizes_of(row.text("dsd")), row.number("temperature_C")};
    INFO(row.text("frequency_GHz") << " GHz, " << row.text("dsd") << ", " << rate_mm_per_h);
    // 2 % is asked for; the same method agrees to the five printed digits and the step's error.
    CHECK(rain_attenuation_dB_per_km(RainLaw::mie, rate_mm_per_h, frequency_Hz, 0.0, 0.0, drops) ==
          tests::within(row.number("attenuation_dB_km"), 1e-4));
    CHECK(rain_eta_m2_per_m3(RainEchoLaw::mie, rate_mm_per_h, frequency_Hz, drops) ==
          tests::within(row.number("eta_m2_m3"), 1e-4));
  }
}

TEST_CASE("The fits of the rain echo keep their stated error", "[rain_scattering]") {
  const auto rows = tests::data_rows("rain_eta_fits.csv");
  REQUIRE(rows.size() == 5);
  for (const auto& row : rows) {
    const double frequency_Hz = row.number("frequency_GHz") * 1e9;
    double largest_dB = 0.0;
    for (double rate = 0.5; rate <= 100.0; rate *= 1.2) {
      const double mie = rain_eta_m2_per_m3(RainEchoLaw::mie, rate, frequency_Hz);
      const double fit = rain_eta_m2_per_m3(RainEchoLaw::mie_fit, rate, frequency_Hz);
      largest_dB = std::max(largest_dB, std::abs(ratio_dB(fit, mie)));
      const double power_law = row.number("A") * std::pow(rate, row.number("B"));
      CHECK(std::abs(ratio_dB(power_law, mie)) < row.number("power_max_dB") + 0.01);
    }
    INFO(row.text("frequency_GHz") << " GHz");
    CHECK(largest_dB == Approx(row.number("quad_max_dB")).epsilon(0.0).margin(0.02));
  }
}

TEST_CASE("Named laws of the echo print what they are known for", "[rain_scattering]") {
  const auto georgia_tech = [](double rate, double frequency_Hz) {
    return rain_eta_m2_per_m3(RainEchoLaw::georgia_tech_1975, rate, frequency_Hz);
  };
  CHECK(georgia_tech(10.0, 35e9) == tests::within(1.2e-6 * std::pow(10.0, 1.6), 1e-14));
  CHECK(georgia_tech(4.0, 95e9) == tests::within(6.0e-5, 1e-14));
  CHECK(georgia_tech(1.0, 70e9) == tests::within(4.2e-5, 1e-14));
  // A low bracket: 6 to 8.5 dB below Mie at 10 mm/h.
  for (const double frequency_Hz : {9.4e9, 35e9, 95e9}) {
    const double below_dB = ratio_dB(rain_eta_m2_per_m3(RainEchoLaw::mie, 10.0, frequency_Hz),
                                     georgia_tech(10.0, frequency_Hz));
    CHECK(below_dB > 5.5);
    CHECK(below_dB < 8.6);
  }
  CHECK(rain_echo_law_named(name_of(RainEchoLaw::mie_fit)) == RainEchoLaw::mie_fit);
  CHECK(drop_sizes_named(name_of(DropSizes::joss_drizzle)) == DropSizes::joss_drizzle);
  CHECK(rain_law_named("mie") == RainLaw::mie);
}

TEST_CASE("Rayleigh's law for rain would be wrong by far at millimetre waves",
          "[rain_scattering]") {
  const auto rayleigh = [](double rate, double wavelength_m) {
    return std::pow(core::kPi, 5.0) * 0.93 * 200.0 * std::pow(rate, 1.6) * 1e-18 /
           std::pow(wavelength_m, 4.0);
  };
  const double at_35 = core::kSpeedOfLight_mps / 35e9;
  const double at_94 = core::kSpeedOfLight_mps / 94e9;
  const auto mie = [](double rate, double frequency_Hz) {
    return rain_eta_m2_per_m3(RainEchoLaw::mie, rate, frequency_Hz);
  };
  CHECK(rayleigh(1.0, at_35) / mie(1.0, 35e9) == Approx(0.57).epsilon(0.01));
  CHECK(rayleigh(50.0, at_35) / mie(50.0, 35e9) == Approx(3.3).epsilon(0.01));
  CHECK(rayleigh(50.0, at_94) / mie(50.0, 94e9) == Approx(190.0).epsilon(0.02));
}

TEST_CASE("A02 echo and Mie loss vanish without rain and refuse the impossible",
          "[rain_scattering][A02]") {
  const DropScattering drops(35e9, 10.0);
  const auto sizes = DropSizes::marshall_palmer;
  CHECK(drops.eta_m2_per_m3(sizes, 0.0) == 0.0);
  CHECK(drops.attenuation_dB_per_km(sizes, 0.0) == 0.0);
  CHECK(std::isfinite(drops.eta_m2_per_m3(sizes, 1e-300)));
  CHECK(drops.eta_m2_per_m3(sizes, 1e-300) >= 0.0);
  double before = 0.0;
  for (double rate = 0.01; rate <= 300.0; rate *= 1.5) {
    const double eta = drops.eta_m2_per_m3(sizes, rate);
    CHECK(eta > before);
    before = eta;
  }
  for (const double bad : {-1.0, 1e6})
    tests::check_rejected([&] { drops.eta_m2_per_m3(sizes, bad); }, ErrorClass::range, "0 to 300");
  for (const double bad : {std::nan(""), HUGE_VAL})
    tests::check_rejected([&] { drops.attenuation_dB_per_km(sizes, bad); }, ErrorClass::nonfinite,
                          "0 to 300");
  tests::check_rejected([] { DropScattering(35e9, -10.0); }, ErrorClass::range, "0 to 40");
  tests::check_rejected([] { rain_eta_m2_per_m3(RainEchoLaw::mie_fit, 1.0, 60e9); },
                        ErrorClass::range, "9.4, 24, 35, 76.5, 94 GHz");
  tests::check_rejected([] { rain_eta_m2_per_m3(RainEchoLaw::mie_fit, 0.1, 35e9); },
                        ErrorClass::range, "0.5 to 100");
  tests::check_rejected([] { drop_sizes_named("gamma"); }, ErrorClass::ref, "joss-drizzle");
}
