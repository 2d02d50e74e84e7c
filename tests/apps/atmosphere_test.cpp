// fanbeam atmosphere: its figures are those of the models.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "atmosphere/loss_table.h"
#include "measure/frequency_choice.h"
#include "tests/apps/program.h"
#include "tests/data_rows.h"

using namespace fanbeam;

namespace {

// A level kilometre at the origin: dB are dB/km.
const std::string kKilometre =
    "atmosphere --json --height 0 --to-height 0 --range 1000 --step 1000 ";

nlohmann::json frequencies_of(const std::string& words) {
  const auto result = tests::run_fanbeam(kKilometre + words);
  INFO(words << "\n" << result.output);
  REQUIRE(result.exit_code == 0);
  return nlohmann::json::parse(result.output)["frequencies"];
}

double figure(const nlohmann::json& row, const char* key) { return row[key].get<double>(); }

}  // namespace

TEST_CASE("Losses by cause add up to that of the whole path", "[atmosphere_command]") {
  atmosphere::Weather weather;
  weather.visibility_m = 150.0;
  weather.rain_rate_mm_per_h = 6.0;
  weather.melting_height_m = 1500.0;
  weather.snow_rate_mm_per_h = 2.0;
  const atmosphere::AtmospherePath path{2500.0, 20.0, 9000.0, 1000.0, 0.1};
  const atmosphere::AtmosphereTable table = atmosphere::atmosphere_table(weather, 35e9, path);
  const atmosphere::PathAttenuation whole(weather, 35e9);
  // Points 2480 m lower are at least that far away.
  REQUIRE(table.rows.size() == 7);
  CHECK(table.rows.front().range_m == 3000.0);
  for (const atmosphere::AtmosphereRow& row : table.rows) {
    CHECK(row.one_way_dB() == Approx(whole.one_way_dB(2500.0, 20.0, row.range_m)).epsilon(1e-6));
    const double sigma0 = row.eta_m2_per_m3 * row.range_m * 0.1;
    CHECK(row.equivalent_sigma0_dB == Approx(10.0 * std::log10(sigma0)).epsilon(1e-12));
  }
  CHECK(atmosphere::atmosphere_models(weather).size() == 7);
}

TEST_CASE("The balance of frequencies has the backscatter of Rayleigh and of Mie",
          "[atmosphere_command]") {
  atmosphere::Weather weather;
  weather.temperature_C = 10.0;
  const measure::PowerBalance fog = measure::fog_balance(weather, 150.0, 2000.0, 35e9, 94e9);
  // Seed text: "larger, by about 17 dB".
  CHECK(fog.backscatter_dB == Approx(17.16).epsilon(0.0).margin(0.01));
  CHECK(fog.attenuation_dB < 0.0);
  // Rain of 10 mm/h, Marshall-Palmer at 10 C: 5.92e-4 over 3.39e-4 m2/m3.
  const measure::PowerBalance rain = measure::rain_balance(weather, 10.0, 2000.0, 35e9, 94e9);
  CHECK(rain.backscatter_dB == Approx(10.0 * std::log10(5.92 / 3.39)).epsilon(0.0).margin(0.05));
  // P.838-3, horizontal: 4 km of 6.436 - 2.709 dB/km, and 4 km of the air's difference.
  CHECK(rain.attenuation_dB < -4.0 * (6.436 - 2.709));
  CHECK(rain.attenuation_dB > -4.0 * (6.436 - 2.709) - 2.0);
  const measure::PowerBalance same = measure::rain_balance(weather, 10.0, 2000.0, 35e9, 35e9);
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

  // P.838-3, table 5: kH = 0.0000847 at 2 GHz, where four decimals would leave one digit.
  const auto low = tests::run_fanbeam("atmosphere --frequency 2 --rain 100");
  CHECK_THAT(low.output, Catch::Contains("rain: k = 8.4687e-05, alpha = 1.0664"));

  const auto scene = tests::run_fanbeam("atmosphere braunschweig-26");
  CHECK(scene.exit_code == 0);
  CHECK_THAT(scene.output, Catch::Contains("P.840"));

  CHECK(tests::run_fanbeam("atmosphere --csv --json").exit_code == 2);
}

TEST_CASE("Weather that no law takes is refused by the name of the option",
          "[atmosphere_command]") {
  const std::pair<const char*, const char*> cases[] = {
      {"--rain -3", "E-RANGE --rain = -3: expected 0 to 300 mm/h"},
      {"--fog-visibility 1", "E-RANGE --fog-visibility = 1: expected 10 to 100000 m"},
      {"--temperature 80", "E-RANGE --temperature = 80: expected -60 to 50 C"},
      {"--rain 3 --snow 3", "E-RANGE --snow = 3: expected a melting layer"},
      {"--snow 3 --frequency 94", "E-RANGE --frequency = 94 GHz: expected"},
      {"--rain-echo-law mie-fit --rain 5 --frequency 50", "E-RANGE --frequency = 50 GHz: expected"},
      {"--compare 35,94 --rain-law georgia-tech-95", "E-RANGE --compare = 35 GHz: expected"}};
  for (const auto& [words, message] : cases) {
    INFO(words);
    const auto result = tests::run_fanbeam(std::string("atmosphere ") + words);
    INFO(result.output);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.output, Catch::StartsWith(message));
  }
}

TEST_CASE("Laws, drops, tops, melting layer and polarisation are options", "[atmosphere_command]") {
  const auto table = [](const std::string& words) {
    const auto result = tests::run_fanbeam("atmosphere --json --range 1000 --step 1000 " + words);
    INFO(words << "\n" << result.output);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(result.output)["frequencies"][0]["rows"][0];
  };
  const auto loss_dB = [&](const std::string& words, const char* cause) {
    return table(words)[cause].get<double>();
  };
  const double rain_dB = loss_dB("--rain 10", "rain_dB");
  CHECK(loss_dB("--rain 10 --polarisation HH", "rain_dB") == rain_dB);
  CHECK(loss_dB("--rain 10 --polarisation VV", "rain_dB") < 0.95 * rain_dB);
  CHECK(loss_dB("--rain 10 --rain-law mie", "rain_dB") != rain_dB);
  CHECK(loss_dB("--rain 10 --rain-law mie --drop-sizes joss-drizzle", "rain_dB") !=
        loss_dB("--rain 10 --rain-law mie", "rain_dB"));
  CHECK(loss_dB("--rain 10 --rain-top 50", "rain_dB") < 0.6 * rain_dB);
  CHECK(loss_dB("--rain 10 --melting-height 2000 --snow 1", "rain_dB") == Approx(rain_dB));
  CHECK(loss_dB("--rain 10 --melting-height 2000 --height 4000 --to-height 3500 --snow 1",
                "snow_dB") > 0.0);
  CHECK(loss_dB("--rain 10 --melting-layer", "rain_dB") == Approx(rain_dB));
  CHECK(loss_dB("--rain 10 --rain-echo-law georgia-tech-1975", "eta_m2_per_m3") !=
        loss_dB("--rain 10", "eta_m2_per_m3"));
  const double fog_dB = loss_dB("--fog-visibility 100", "fog_dB");
  CHECK(loss_dB("--fog-visibility 100 --fog-type zhao-advection", "fog_dB") != fog_dB);
  CHECK(loss_dB("--fog-visibility 100 --fog-law altshuler", "fog_dB") != fog_dB);
  for (const char* words : {"--rain-top 100 --melting-layer", "--rain-law itu", "--vertical",
                            "--polarisation HV", "--data somewhere"})
    CHECK(tests::run_fanbeam(std::string("atmosphere ") + words).exit_code == 2);
}

TEST_CASE("--compare refuses what it would not look at; --quiet leaves the tables",
          "[atmosphere_command]") {
  const std::string compare = "atmosphere --compare 35,94 --temperature 10";
  for (const char* words : {"--json", "--csv", "--range 1000", "--step 100", "--height 50",
                            "--to-height 5", "--frequency 35", "--rain 3", "--rain-top 100",
                            "--snow 3", "--snow-top 100", "--fog-visibility 100", "--fog-water 0.1",
                            "--fog-top 50", "--melting-layer", "--melting-height 1000"}) {
    INFO(words);
    CHECK(tests::run_fanbeam(compare + " " + words).exit_code == 2);
  }
  const auto figures = tests::run_fanbeam(compare);
  CHECK(figures.exit_code == 0);
  CHECK_THAT(figures.output, Catch::StartsWith("two-way dB over 2000"));
  CHECK(tests::run_fanbeam(compare + " --quiet").output == figures.output);
  const std::string notes_and_table = tests::run_fanbeam("atmosphere --rain 5").output;
  const std::string table = tests::run_fanbeam("atmosphere --rain 5 -q").output;
  CHECK_THAT(table, Catch::Contains("35 GHz\n   range"));
  CHECK_THAT(table, !Catch::Contains("P.838"));
  CHECK_THAT(notes_and_table, Catch::Contains("P.838") && Catch::EndsWith(table));
}

TEST_CASE("Oxygen and vapour apart meet the ITU's P.676-13 examples, in dry pressure and density",
          "[atmosphere_command]") {
  const auto rows = tests::data_rows("itu_p676_13_validation.csv");
  REQUIRE(rows.size() == 120);
  std::string list;
  for (const auto& row : rows) {
    // All of one air.
    REQUIRE((row.number("p_dry_hPa") == 1013.25 && row.number("T_K") == 288.15 &&
             row.number("rho_gm3") == 7.5));
    list += (list.empty() ? "" : ",") + row.text("f_GHz");
  }
  const nlohmann::json found = frequencies_of(
      "--frequency " + list + " --dry-pressure 1013.25 --temperature 15 --vapour-density 7.5");
  REQUIRE(found.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    INFO(rows[i].text("f_GHz") << " GHz");
    const nlohmann::json& row = found[i]["rows"][0];
    CHECK(figure(row, "oxygen_dB") == Approx(rows[i].number("gamma_oxygen")).epsilon(1e-9));
    CHECK(figure(row, "vapour_dB") == Approx(rows[i].number("gamma_water")).epsilon(1e-9));
    CHECK(figure(row, "gas_dB") == Approx(rows[i].number("gamma_total")).epsilon(1e-9));
  }
}

TEST_CASE("Dry pressure and humidity, total pressure and density are the same air",
          "[atmosphere_command]") {
  // P.453-14 equation 9 over water at t = 20 C, with 1 + 1e-4 (7.2 + P (0.0320 + 5.9e-6 t^2)).
  const double saturated_hPa =
      1.0042016 * 6.1121 * std::exp((18.678 - 20.0 / 234.5) * 20.0 / (20.0 + 257.14));
  const double vapour_hPa = 0.6 * saturated_hPa;
  const auto air = [](const std::string& words) {
    return frequencies_of("--frequency 22.235 --temperature 20 " + words)[0]["rows"][0];
  };
  const auto text = [](double value) { return " " + std::to_string(value); };
  const nlohmann::json total = air("--pressure 1013.25 --humidity 0.6");
  const nlohmann::json dry = air("--humidity 0.6 --dry-pressure" + text(1013.25 - vapour_hPa));
  const nlohmann::json density =
      air("--pressure 1013.25 --vapour-density" + text(vapour_hPa * 216.7 / 293.15));
  for (const char* cause : {"oxygen_dB", "vapour_dB"}) {
    INFO(cause);
    CHECK(figure(dry, cause) == Approx(figure(total, cause)).epsilon(1e-5));
    CHECK(figure(density, cause) == Approx(figure(total, cause)).epsilon(1e-5));
  }
  // Taking dry for total pressure would be seen: 1.4 % of oxygen's loss.
  CHECK(figure(air("--pressure" + text(1013.25 - vapour_hPa) + " --humidity 0.6"), "oxygen_dB") <
        0.98 * figure(total, "oxygen_dB"));
  CHECK(figure(air("--vapour-density 0"), "vapour_dB") == 0.0);
}

TEST_CASE("Rain at any tilt and path elevation meets the ITU's P.838-3 examples",
          "[atmosphere_command]") {
  const auto rows = tests::data_rows("itu_p838_3_validation.csv");
  REQUIRE(rows.size() == 32);
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    const auto& row = rows[i];
    const nlohmann::json found = frequencies_of(
        "--frequency " + row.text("f_GHz") + " --rain " + row.text("rain_mm_h") + " --tilt " +
        row.text("tau_deg") + " --path-elevation " + row.text("elevation_deg"))[0];
    INFO(row.text("f_GHz") << " GHz, elevation " << row.text("elevation_deg") << ", tilt "
                           << row.text("tau_deg"));
    CHECK(figure(found["rain"], "k") == Approx(row.number("k")).epsilon(0.0).margin(6e-9));
    CHECK(figure(found["rain"], "alpha") == Approx(row.number("alpha")).epsilon(0.0).margin(6e-9));
    CHECK(figure(found["rows"][0], "rain_dB") ==
          Approx(row.number("gamma_dB_km")).epsilon(0.0).margin(6e-9));
  }
  // Circular, 45 deg: k is the mean of P.838-3's 0.3374 and 0.3224 at 35 GHz, alpha their mean
  // weighted with k, whatever the elevation.
  for (const char* elevation : {"0", "60"}) {
    const nlohmann::json circular = frequencies_of("--frequency 35 --rain 10 --tilt 45 " +
                                                   ("--path-elevation " + std::string(elevation)));
    CHECK(figure(circular[0]["rain"], "k") == Approx(0.3299).epsilon(0.0).margin(5e-5));
    CHECK(figure(circular[0]["rain"], "alpha") ==
          Approx((0.3374 * 0.9047 + 0.3224 * 0.8761) / 0.6598).epsilon(0.0).margin(1e-4));
  }
  const auto rain_dB = [](const std::string& words) {
    return figure(frequencies_of("--rain 10 " + words)[0]["rows"][0], "rain_dB");
  };
  CHECK(rain_dB("--tilt 0") == rain_dB("--polarisation HH"));
  CHECK(rain_dB("--tilt 90") == rain_dB("--polarisation VV"));
}

TEST_CASE("Air that there is not, and options that do nothing, are refused in the user's words",
          "[atmosphere_command]") {
  const std::pair<const char*, const char*> cases[] = {
      {"--vapour-density 30 --temperature 15",
       "E-RANGE --vapour-density = 30: expected 0 to 12.88 g/m3, where air of 15 C is saturated"},
      {"--dry-pressure 1200",
       "E-RANGE --dry-pressure = 1200: expected 300 to 1100 hPa together with the vapour's"},
      {"--dry-pressure 100", "E-RANGE --dry-pressure = 100"},
      {"--dry-pressure nan", "E-NONFINITE --dry-pressure = nan"},
      {"--temperature 80 --vapour-density 7", "E-RANGE --temperature = 80: expected -60 to 50 C"},
      {"--rain 5 --rain-law mie --tilt 45 --path-elevation 10",
       "E-RANGE --tilt = 45: expected the rain law itu-p838, as mie does not know it\n"
       "E-RANGE --path-elevation = 10"},
      {"--rain 5 --rain-echo-law mie-fit --drop-sizes joss-drizzle",
       "E-RANGE --drop-sizes = joss-drizzle: expected the rain law or the rain echo law mie, as "
       "itu-p838 and mie-fit do not know it\n"},
      {"--compare 90,100 --rain-law georgia-tech-95 --tilt 45 --path-elevation 10",
       "E-RANGE --tilt = 45: expected the rain law itu-p838, as georgia-tech-95 does not know it\n"
       "E-RANGE --path-elevation = 10"},
      {"--compare 35,94 --rain-echo-law mie-fit --drop-sizes joss-drizzle",
       "E-RANGE --drop-sizes = joss-drizzle"},
      {"--fog-top 50 --fog-type kunkel",
       "E-REF --fog-top = 50: expected --fog-visibility or --fog-water beside it, or a scene that "
       "has it\nE-REF --fog-type = kunkel: expected --fog-visibility beside it"},
      {"--fog-water 0.1 --fog-type kunkel", "E-REF --fog-type = kunkel: expected --fog-visibility"},
      {"--rain-top 50", "E-REF --rain-top = 50: expected --rain beside it"},
      {"--rain-law mie --drop-sizes joss-drizzle",
       "E-REF --rain-law = mie: expected --rain beside it, or a scene that has it\n"
       "E-REF --drop-sizes = joss-drizzle"},
      {"--snow-top 50", "E-REF --snow-top = 50: expected --snow beside it"},
      {"--melting-layer", "E-REF --melting-layer = given: expected --rain or --snow beside it"},
      {"--height 500 --range 400",
       "E-RANGE --range = 400: expected at least 500 m, what --height and --to-height are apart"},
      {"--fog-water 0.1 --fog-law centimetre --frequency 16",
       "E-RANGE --frequency = 16 GHz: expected 3 to 15 GHz for the fog law centimetre\n"},
      {"--fog-water 0.1 --fog-law centimetre",
       "E-RANGE frequency = 35 GHz: expected 3 to 15 GHz for the fog law centimetre\n"},
      {"--rain-echo-law mie-fit --rain 5 --frequency 50",
       "E-RANGE --frequency = 50 GHz: expected within 2 % of 9.4, 24, 35, 76.5, 94 GHz for"}};
  for (const auto& [words, message] : cases) {
    INFO(words);
    const auto result = tests::run_fanbeam(std::string("atmosphere ") + words);
    INFO(result.output);
    CHECK((result.exit_code == 2 || result.exit_code == 3));
    CHECK_THAT(result.output, Catch::StartsWith(message));
  }
  for (const char* words :
       {"--vapour-density -1", "--vapour-density nan", "--vapour-density 7 --humidity 0.5",
        "--dry-pressure 1000 --pressure 1000", "--tilt 200", "--tilt nan", "--path-elevation 91",
        "--tilt 45 --polarisation HH"}) {
    INFO(words);
    CHECK(tests::run_fanbeam(std::string("atmosphere ") + words).exit_code == 2);
  }
  for (const char* words :
       {"--fog-water 0.1 --fog-law centimetre --frequency 15", "--rain 0 --rain-top 500",
        "--rain 5 --rain-law mie --rain-echo-law mie-fit --drop-sizes joss-drizzle",
        "--compare 35,94 --tilt 45 --drop-sizes joss-drizzle", "braunschweig-26 --fog-top 50",
        "rain-94ghz --rain-law mie", "--height 500 --range 500"}) {
    INFO(words);
    CHECK(tests::run_fanbeam(std::string("atmosphere ") + words).exit_code == 0);
  }
}
