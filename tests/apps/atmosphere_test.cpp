// fanbeam atmosphere: its figures are those of the models.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/atmosphere_table.h"
#include "apps/frequency_choice.h"
#include "tests/apps/program.h"

using namespace fanbeam;

TEST_CASE("Losses by cause add up to that of the whole path", "[atmosphere_command]") {
  atmosphere::Weather weather;
  weather.visibility_m = 150.0;
  weather.rain_rate_mm_per_h = 6.0;
  weather.melting_height_m = 1500.0;
  weather.snow_rate_mm_per_h = 2.0;
  const apps::AtmospherePath path{2500.0, 20.0, 9000.0, 1000.0, 0.1};
  const apps::AtmosphereTable table = apps::atmosphere_table(weather, 35e9, path);
  const atmosphere::PathAttenuation whole(weather, 35e9);
  // Points 2480 m lower are at least that far away.
  REQUIRE(table.rows.size() == 7);
  CHECK(table.rows.front().range_m == 3000.0);
  for (const apps::AtmosphereRow& row : table.rows) {
    CHECK(row.total_one_way_dB() ==
          Approx(whole.one_way_dB(2500.0, 20.0, row.range_m)).epsilon(1e-6));
    const double sigma0 = row.eta_m2_per_m3 * row.range_m * 0.1;
    CHECK(row.equivalent_sigma0_dB == Approx(10.0 * std::log10(sigma0)).epsilon(1e-12));
  }
  CHECK(apps::atmosphere_models(weather).size() == 7);
}

TEST_CASE("The balance of frequencies has the backscatter of Rayleigh and of Mie",
          "[atmosphere_command]") {
  atmosphere::Weather weather;
  weather.temperature_C = 10.0;
  const apps::PowerBalance fog = apps::fog_balance(weather, 150.0, 2000.0, 35e9, 94e9);
  // Seed text: "larger, by about 17 dB".
  CHECK(fog.backscatter_dB == Approx(17.16).margin(0.01));
  CHECK(fog.attenuation_dB < 0.0);
  // Rain of 10 mm/h, Marshall-Palmer at 10 C: 5.92e-4 over 3.39e-4 m2/m3.
  const apps::PowerBalance rain = apps::rain_balance(weather, 10.0, 2000.0, 35e9, 94e9);
  CHECK(rain.backscatter_dB == Approx(10.0 * std::log10(5.92 / 3.39)).margin(0.05));
  // P.838-3, horizontal: 4 km of 6.436 - 2.709 dB/km, and 4 km of the air's difference.
  CHECK(rain.attenuation_dB < -4.0 * (6.436 - 2.709));
  CHECK(rain.attenuation_dB > -4.0 * (6.436 - 2.709) - 2.0);
  const apps::PowerBalance same = apps::rain_balance(weather, 10.0, 2000.0, 35e9, 35e9);
  CHECK(same.backscatter_dB == 0.0);
  CHECK(same.attenuation_dB == 0.0);
}

TEST_CASE("The command prints JSON, CSV and tables, and refuses bad weather",
          "[atmosphere_command]") {
  const auto json_run =
      tests::run_fanbeam("atmosphere --frequency 35,94 --rain 10 --temperature 10 --json");
  REQUIRE(json_run.exit_code == 0);
  const auto json = nlohmann::json::parse(json_run.output);
  REQUIRE(json["frequencies"].size() == 2);
  const auto& rows = json["frequencies"][0]["rows"];
  REQUIRE(rows.size() == 8);
  CHECK(rows[7]["range_m"] == 4000.0);
  CHECK(rows[7]["rain_dB"].get<double>() == Approx(4.0 * 2.7092).epsilon(1e-4));
  CHECK(rows[0]["eta_m2_per_m3"].get<double>() == Approx(3.39e-4).epsilon(2e-3));
  CHECK(json["models"][1]["source"] == "Recommendation ITU-R P.838-3");

  const auto csv = tests::run_fanbeam("atmosphere --csv --range 1000 --step 500");
  REQUIRE(csv.exit_code == 0);
  CHECK(std::count(csv.output.begin(), csv.output.end(), '\n') == 3);
  CHECK_THAT(csv.output, Catch::StartsWith("frequency_GHz,range_m,gas_dB"));

  const auto scene = tests::run_fanbeam("atmosphere braunschweig-26");
  CHECK(scene.exit_code == 0);
  CHECK_THAT(scene.output, Catch::Contains("P.840"));

  CHECK(tests::run_fanbeam("atmosphere --rain -3").exit_code == 3);
  CHECK(tests::run_fanbeam("atmosphere --snow 3 --frequency 94").exit_code == 3);
  CHECK(tests::run_fanbeam("atmosphere --csv --json").exit_code == 2);
}
