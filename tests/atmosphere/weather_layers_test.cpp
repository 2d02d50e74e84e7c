// Fog in layers and air known at several heights.
#include <cmath>

#include "atmosphere/air_column.h"
#include "atmosphere/path_attenuation.h"
#include "tests/atmosphere/rejection.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;
using core::ErrorClass;

namespace {

FogLayer layer(double liquid_water_g_per_m3, double base_m, double top_m) {
  FogLayer fog;
  fog.liquid_water_g_per_m3 = liquid_water_g_per_m3;
  fog.base_m = base_m;
  fog.top_m = top_m;
  return fog;
}

Weather without_gas() {
  Weather weather;
  weather.simulate_gas = false;
  weather.temperature_C = 10.0;
  return weather;
}

// The reference atmosphere taken every `step_m` and given as levels.
Weather standard_levels(double step_m, double origin_height_m) {
  Weather weather;
  weather.origin_height_m = origin_height_m;
  const StandardAtmosphere standard;
  for (double height_m = -1000.0; height_m <= 10000.0; height_m += step_m) {
    const AirState air = standard.at(origin_height_m + height_m);
    weather.levels.push_back(
        {height_m, air.temperature_K - 273.15,
         air.vapour_density_g_per_m3 /
             saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa),
         std::nullopt});
  }
  return weather;
}

}  // namespace

TEST_CASE("Fog layers add and end at their heights", "[fog_layers]") {
  Weather one = without_gas(), two = without_gas(), both = without_gas();
  one.fog_layers = {layer(0.2, -2000.0, 100.0)};
  two.fog_layers = {layer(0.5, 60.0, 300.0)};
  both.fog_layers = {one.fog_layers[0], two.fog_layers[0]};
  const PathAttenuation a(one, 35e9), b(two, 35e9), ab(both, 35e9);
  for (const double from_m : {-100.0, 60.0, 80.0, 99.9, 100.0, 250.0, 300.0})
    for (const double to_m : {-50.0, 70.0, 100.0, 299.0, 400.0})
      CHECK(ab.one_way_dB(from_m, to_m, 3000.0) ==
            Approx(a.one_way_dB(from_m, to_m, 3000.0) + b.one_way_dB(from_m, to_m, 3000.0))
                .epsilon(1e-12)
                .margin(1e-14));
  const double per_km =
      fog_attenuation_dB_per_km(FogLaw::itu_p840, 0.5, 35e9, AirColumn(two).temperature_C(180.0));
  CHECK(b.one_way_attenuation_dB_per_km(60.0).fog_dB_per_km == tests::within(per_km, 1e-14));
  CHECK(b.one_way_attenuation_dB_per_km(59.999).fog_dB_per_km == 0.0);
  CHECK(b.one_way_attenuation_dB_per_km(300.0).fog_dB_per_km == 0.0);
  CHECK(b.one_way_dB(0.0, 1000.0, 1000.0) == tests::within(per_km * 0.24, 1e-12));
}

TEST_CASE("A layer from the ground is the same as the plain fog keys", "[fog_layers]") {
  Weather plain = without_gas();
  plain.simulate_gas = true;
  plain.visibility_m = 200.0;
  plain.fog_top_m = 120.0;
  plain.fog_water_model = FogWaterModel::zhao_advection;
  Weather listed = without_gas();
  listed.simulate_gas = true;
  FogLayer fog;
  fog.visibility_m = 200.0;
  fog.top_m = 120.0;
  fog.water_model = FogWaterModel::zhao_advection;
  listed.fog_layers = {fog};
  const PathAttenuation a(plain, 35e9), b(listed, 35e9);
  for (double height_m = -300.0; height_m < 400.0; height_m += 13.0)
    CHECK(a.one_way_dB(height_m, 20.0, 2500.0) == b.one_way_dB(height_m, 20.0, 2500.0));
}

TEST_CASE("A05 layers, melting and gas together do not care about cuts", "[fog_layers][A05]") {
  Weather weather;
  weather.temperature_C = 9.0;
  weather.fog_layers = {layer(0.3, -2000.0, 80.0), layer(0.8, 400.0, 700.0)};
  weather.rain_rate_mm_per_h = 8.0;
  weather.snow_rate_mm_per_h = 8.0;
  weather.melting_height_m = 900.0;
  const PathAttenuation path(weather, 35e9);
  const double whole = path.one_way_dB(1900.0, -10.0, 10000.0);
  for (const int pieces : {1, 7, 1000}) {
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i)
      sum += path.one_way_dB(1900.0 - 1910.0 * i / pieces, 1900.0 - 1910.0 * (i + 1) / pieces,
                             10000.0 / pieces);
    CHECK(sum == tests::within(whole, 1e-12));
  }
  for (double height_m = -100.0; height_m < 3000.0; height_m += 11.0)
    REQUIRE(path.one_way_attenuation_dB_per_km(height_m).total_dB_per_km() <=
            path.largest_one_way_dB_per_km(-100.0, 3000.0));
  CHECK(path.largest_one_way_dB_per_km(100.0, 100.0) ==
        tests::within(path.one_way_attenuation_dB_per_km(100.0).total_dB_per_km(), 1e-14));
}

TEST_CASE("Levels of the reference atmosphere give its loss back", "[sounding]") {
  for (const double origin_height_m : {0.0, 600.0})
    for (const double frequency_Hz : {24e9, 35e9, 76.5e9, 94e9}) {
      Weather reference;
      reference.origin_height_m = origin_height_m;
      const PathAttenuation standard(reference, frequency_Hz);
      const PathAttenuation levels(standard_levels(250.0, origin_height_m), frequency_Hz);
      for (const double top_m : {0.0, 130.0, 1000.0, 5000.0, 11500.0})
        CHECK(levels.one_way_dB(0.0, top_m, 12000.0) ==
              tests::within(standard.one_way_dB(0.0, top_m, 12000.0), 2e-4));
    }
}

TEST_CASE("Between levels temperature and humidity are linear, pressure is hydrostatic",
          "[sounding]") {
  // An isothermal layer: P falls by exp(-34.1632 h'/T).
  const Sounding isothermal({{0.0, 6.85, 0.5, 1000.0}, {2000.0, 6.85, 0.9, std::nullopt}}, 0.0,
                            std::nullopt);
  const AirState half = isothermal.at(1000.0);
  const double h_km = 6356.766 * 1.0 / 6357.766;
  CHECK(half.temperature_K == Approx(280.0).epsilon(1e-12));
  CHECK(half.pressure_hPa == tests::within(1000.0 * std::exp(-34.1632 * h_km / 280.0), 1e-12));
  CHECK(half.vapour_density_g_per_m3 /
            saturation_vapour_density_g_per_m3(half.temperature_K, half.pressure_hPa) ==
        Approx(0.7).epsilon(0.0).margin(1e-4));

  // Given pressures are met, and the origin's where it alone is given.
  const Sounding measured({{0.0, 10.0, 0.5, 1002.0}, {1500.0, 2.0, 0.5, 830.0}}, 100.0,
                          std::nullopt);
  CHECK(measured.at(100.0).pressure_hPa == tests::within(1002.0, 1e-12));
  CHECK(measured.at(1600.0).pressure_hPa == tests::within(830.0, 1e-12));
  const Sounding anchored({{500.0, 4.0, 0.5, std::nullopt}}, 100.0, 990.0);
  CHECK(anchored.at(100.0).pressure_hPa == tests::within(990.0, 1e-12));

  // An inversion: linear between the levels, the reference lapse beyond them.
  const Sounding inversion({{0.0, 0.0, 1.0, std::nullopt}, {100.0, 5.0, 0.4, std::nullopt}}, 0.0,
                           std::nullopt);
  CHECK(inversion.at(50.0).temperature_K == Approx(275.65).epsilon(0.0).margin(1e-4));
  CHECK(inversion.at(1100.0).temperature_K == Approx(278.15 - 6.5).epsilon(0.0).margin(2e-3));
  CHECK(inversion.at(-500.0).temperature_K == Approx(273.15 + 3.25).epsilon(0.0).margin(1e-3));
  CHECK(inversion.at(19000.0).temperature_K == inversion.at(12000.0).temperature_K);
}

TEST_CASE("The 0 C level of a sounding is the highest one", "[sounding]") {
  Weather weather;
  weather.levels = {{0.0, -3.0, 0.9, std::nullopt},
                    {300.0, 4.0, 0.9, std::nullopt},
                    {1300.0, -6.0, 0.5, std::nullopt}};
  const auto zero_m = AirColumn(weather).zero_celsius_m();
  REQUIRE(zero_m);
  CHECK(*zero_m == Approx(700.0).epsilon(0.0).margin(0.2));
}

TEST_CASE("Levels that make air no gas law takes are refused by the level they come of",
          "[sounding]") {
  const auto told = [](std::vector<AirLevel> levels, std::optional<double> visibility_m = {}) {
    Weather weather;
    weather.levels = std::move(levels);
    weather.visibility_m = visibility_m;
    const core::ProblemList problems = problems_in(weather, 35e9);
    if (!problems.has_errors()) PathAttenuation(weather, 35e9);
    return problems.all().empty() ? "" : core::to_string(problems.all()[0]);
  };
  // kPa for hPa: the vapour alone weighs more.
  CHECK_THAT(told({{0.0, 45.0, 0.9, 101.3}}),
             Catch::Contains("level[0].pressure_hPa = 101.3") && Catch::Contains("at -2000 m"));
  CHECK_THAT(told({{0.0, 20.0, 0.5, 1000.0}, {1000.0, 50.0, 0.1, 100.0}}),
             Catch::Contains("level[1].pressure_hPa = 100"));
  // 10 C at 10 km are 88 C at -2 km.
  CHECK_THAT(
      told({{10000.0, 10.0, 0.5, std::nullopt}}),
      Catch::Contains("level[0].temperature_C = 10: expected air of -173 to 77 C at -2000 m, not "
                      "of 87.9"));
  CHECK_THAT(told({{12000.0, -60.0, 0.5, 1100.0}}),
             Catch::Contains("level[0].pressure_hPa = 1100") && Catch::Contains("to 2000 hPa"));
  CHECK(told({{0.0, 50.0, 1.0, std::nullopt}}, 50.0).empty());
  CHECK(told({{0.0, -90.0, 1.0, 1050.0}}).empty());
  CHECK(told({{0.0, 15.0, 0.5, 1013.0}, {12000.0, -60.0, 0.1, 190.0}}).empty());
}

// Through kelvin and back it was told as -49.99999999999997.
TEST_CASE("A temperature that is too low for fog is told as it is given", "[sounding]") {
  for (const double origin_m : {0.0, 80.0, 500.0})
    for (const double temperature_C : {-50.0, -41.3}) {
      Weather weather;
      weather.origin_height_m = origin_m;
      weather.visibility_m = 300.0;
      weather.temperature_C = temperature_C;
      const core::ProblemList problems = problems_in(weather, 35e9);
      REQUIRE(problems.all().size() == 1);
      CHECK(core::to_string(problems.all()[0]) ==
            "E-RANGE temperature_C = " + core::number_text(temperature_C) +
                ": expected -40 to 50 C where there is fog");
    }
}

TEST_CASE("Wrong levels and layers are refused, all problems together", "[sounding]") {
  Weather weather;
  weather.levels = {{100.0, 3.0, 0.5, std::nullopt}, {50.0, 70.0, 1.5, 20.0}};
  weather.temperature_C = 3.0;
  weather.fog_layers = {layer(0.1, 50.0, 50.0), FogLayer{}};
  const core::ProblemList problems = problems_in(weather, 35e9);
  std::string texts;
  for (const core::Problem& problem : problems.all()) texts += core::to_string(problem) + "\n";
  CHECK(problems.all().size() == 7);
  for (const char* part :
       {"level[1].height_m = 50: expected above the level before", "level[1].temperature_C = 70",
        "level[1].humidity = 1.5", "level[1].pressure_hPa = 20", "no value beside levels",
        "fog_layer[0].top_m = 50: expected above base_m = 50",
        "fog_layer[1].visibility_m = missing"})
    CHECK_THAT(texts, Catch::Contains(part));
}
