// fanbeam track: a scenario file to tables and metrics, the same bytes again; what it refuses.
#include <algorithm>
#include <sstream>

#include "scenes/highway_reader.h"
#include "session/signal/tracks/scenario_record.h"
#include "session/signal/tracks/study.h"
#include "tests/apps/program.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

constexpr const char* kScenario = R"({"format": "highway-scenarios", "version": 1,
  "radar": {"center_frequency_hz": 76e9, "sweep_bandwidth_hz": 250e6, "tx_power_w": 0.004,
    "tx_gain_db": 32, "rx_gain_db": 27, "noise_figure_db": 4.5, "system_loss_db": 0,
    "max_range_m": 200, "virtual_ula_elements": 12, "virtual_ula_spacing_wavelengths": 0.5,
    "frame_period_s": 0.05},
  "scenarios": [{"id": "X1", "title": "two cars", "duration_s": 1.0, "ego_speed_mps": 20,
    "targets": [
      {"id": "A", "kind": "car", "swerling": 0, "rcs_m2": 10, "motion": "piecewise-acceleration",
       "position_m": [50, 3], "velocity_mps": [22, 0], "segments": []},
      {"id": "B", "kind": "car", "swerling": 0, "rcs_m2": 10, "motion": "piecewise-acceleration",
       "position_m": [90, -3], "velocity_mps": [10, 0], "segments": []}]}]})";

using Table = std::vector<std::vector<std::string>>;

// Of a page of Markdown: rows of cells, their two lines of heading included.
std::vector<Table> tables_of(const std::string& page) {
  std::vector<Table> tables;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line); inside = line.starts_with('|')) {
    if (!line.starts_with('|')) continue;
    if (!inside) tables.emplace_back();
    std::istringstream cells(line.substr(1));
    tables.back().emplace_back();
    for (std::string cell; std::getline(cells, cell, '|');) tables.back().back().push_back(cell);
  }
  return tables;
}

std::string without_targets() {
  std::string empty = kScenario;
  return empty.replace(empty.find("\"targets\": ["), std::string::npos, "\"targets\": []}]}");
}

// Names kept in every draw of every family, and errors that are what is told: `low` to `high` hold 95 % of the means
// of so many (chi-square of 4 degrees). A hundred draws are those of tests/tracking/families_test.cpp.
void check_families(const Table& table, int draws, double low, double high) {
  REQUIRE(table.size() == 2 + 6);
  for (std::size_t i = 2; i < table.size(); ++i) {
    INFO(table[i][0]);
    CHECK(std::stod(table[i][1]) >= 0.97);
    CHECK(std::stoi(table[i][3]) == draws);
    CHECK(std::stod(table[i][4]) >= low);
    CHECK(std::stod(table[i][4]) <= high);
  }
}

}  // namespace

TEST_CASE("track writes tables and metrics, the same bytes again", "[track]") {
  const tests::TemporaryFolder folder;
  folder.write("two.json", kScenario);
  const auto run = [&](const char* name, const std::string& words) {
    const fs::path out = folder.path() / name;
    const auto result = tests::run_fanbeam("track " + tests::quoted(folder.path() / "two.json") +
                                           " --quiet " + words + " -o " + tests::quoted(out));
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    return tests::results(out);
  };
  const auto first = run("a", "");
  CHECK(first.at("X1/tracks.csv").starts_with("time_s,track,confirmed,x_m,y_m"));
  // 21 frames of two measurements.
  const std::string& measured = first.at("X1/measurements.csv");
  CHECK(std::count(measured.begin(), measured.end(), '\n') == 1 + 21 * 2);
  const auto record = nlohmann::json::parse(first.at("run.json"));
  CHECK(record["scenarios"][0]["confirmed_tracks"] == 2);
  CHECK(record["scenarios"][0]["switches"] == 0);
  CHECK(record["scenarios"][0]["range_rmse_m"] < 0.01);
  const auto& scenario = record["scenarios"][0];
  CHECK(scenario["skipped_updates"] == 0);
  CHECK(scenario["left_out_of_joint"] == 0);
  CHECK(scenario["crossings"].empty());
  REQUIRE(scenario["tracks_at_end"].size() == 2);
  for (const auto& track : scenario["tracks_at_end"]) {
    CHECK(track["identity_probability"] == 1.0);
    CHECK(track["kind"] == "car");
    CHECK(std::abs(track["range_m"].get<double>() - track["target_range_m"].get<double>()) < 0.01);
  }
  CHECK(run("b", "") == first);
  CHECK(run("c", "--seed 7").at("X1/tracks.csv") != first.at("X1/tracks.csv"));
  CHECK(run("d", "--run 1").at("X1/tracks.csv") != first.at("X1/tracks.csv"));
  CHECK(run("e", "--association joint --waveform two-slopes --false-measurements 3")
            .count("X1/tracks.csv") == 1);
}

TEST_CASE("Plots of a scenario go with the next run, and no picture that the record does not list",
          "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path file = folder.write("two.json", kScenario), out = folder.path() / "out";
  const auto run = [&] { REQUIRE(tests::track(file, out).exit_code == 0); };
  const std::vector<std::string> pictures = {"errors.png", "ranges.svg"};
  for (const char* scenario : {"X1", "X2"}) fs::create_directories(out / scenario);
  for (const std::string& name : pictures) folder.write("out/X1/" + name, "mine");
  run();
  run();
  for (const std::string& name : pictures) CHECK(tests::bytes_of(out / "X1" / name) == "mine");
  nlohmann::json record = tests::json_of(out / "run.json");
  record["plots"] = nlohmann::json::array({"X1/errors.png", "X2/errors.png"});
  folder.write("out/run.json", record.dump());
  folder.write("out/X2/errors.png", "of a scenario that is not tracked again");
  run();
  CHECK_FALSE(fs::exists(out / "X1/errors.png"));
  CHECK(fs::exists(out / "X1/ranges.svg"));
  CHECK(fs::exists(out / "X2/errors.png"));
  CHECK(tests::json_of(out / "run.json")["plots"] == nlohmann::json::array({"X2/errors.png"}));
}

// The normalised error squared was 0.0 there: better than honest.
TEST_CASE("A scenario without targets has no figures of them", "[track]") {
  const tests::TemporaryFolder folder;
  folder.write("empty.json", without_targets());
  const fs::path out = folder.path() / "out";
  const auto result = tests::run_fanbeam("track " + tests::quoted(folder.path() / "empty.json") +
                                         " -o " + tests::quoted(out));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("MOTA -, 0 switches, range -, speed -") != std::string::npos);
  const auto scenario = tests::json_of(out / "run.json")["scenarios"][0];
  for (const char* figure : {"mota", "motp_m", "range_rmse_m", "range_rate_rmse_mps", "nees_mean"})
    CHECK(scenario.at(figure).is_null());
}

// They were 1 and 0 mm.
TEST_CASE("A study of a scenario without targets has dashes where figures would be of them",
          "[track]") {
  const scenes::HighwayFile file = scenes::parse_highway(without_targets(), "empty.json");
  const std::vector<Table> tables = tables_of(
      session::study_tracks(session::chosen_scenarios(file, "", {}), session::TrackSettings())
          .text);
  REQUIRE(tables.size() == 1);
  REQUIRE(tables[0].size() == 2 + 11);
  for (std::size_t i = 2; i < tables[0].size(); ++i)
    for (const std::size_t figure : {4U, 7U}) CHECK(tables[0][i][figure] == " - ");
}

TEST_CASE("track refuses what it cannot use", "[track]") {
  const tests::TemporaryFolder folder;
  folder.write("two.json", kScenario);
  const auto code = [&](const std::string& words) {
    return tests::run_fanbeam("track " + words + " -o " + tests::quoted(folder.path() / "out"))
        .exit_code;
  };
  const std::string file = tests::quoted(folder.path() / "two.json");
  CHECK(code("") == 2);
  CHECK(code(file + " --scenario X9") == 2);
  CHECK(code(file + " --waveform sawtooth") == 2);
  CHECK(code(file + " --detection-probability 1.5") == 2);
  CHECK(code(tests::quoted(folder.path() / "none.json")) == 4);
  std::string hostile = kScenario;
  hostile.replace(hostile.find("\"X1\""), 4, "\"../../X1\"");
  folder.write("two.json", hostile);
  CHECK(code(file) == 3);
  folder.write("two.json", "{");
  CHECK(code(file) == 3);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}

// 256 chirps of 20 us and a triangle take 9.1 ms.
TEST_CASE("track refuses a waveform that takes longer than a scenario's frames", "[track]") {
  const tests::TemporaryFolder folder;
  std::string quick = kScenario;
  quick.replace(quick.find("\"duration_s\": 1.0"), 17,
                "\"radar_overrides\": {\"frame_period_s\": 0.008}, \"duration_s\": 0.1");
  folder.write("two.json", quick);
  const std::string words = "track " + tests::quoted(folder.path() / "two.json") + " -o " +
                            tests::quoted(folder.path() / "out");
  const auto refused = tests::run_fanbeam(words);
  INFO(refused.output);
  CHECK(refused.exit_code == 3);
  CHECK(refused.output.find("scenario X1 waveform two-stage = 0.00912 s of ramps") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  CHECK(tests::run_fanbeam(words + " --waveform triangle").exit_code == 0);
}

TEST_CASE("track prints the probability of a swap after a crossing, and where each car is",
          "[track]") {
  const tests::TemporaryFolder folder;
  std::string crossing = kScenario;
  const auto replace = [&](const std::string& from, const std::string& to) {
    crossing.replace(crossing.find(from), from.size(), to);
  };
  // 3 m apart, 1 m/s difference: together after 3 s, apart again after 5.
  replace("\"duration_s\": 1.0", "\"duration_s\": 6.0");
  replace("[50, 3], \"velocity_mps\": [22, 0]", "[50, 0], \"velocity_mps\": [20.5, 0]");
  replace("[90, -3], \"velocity_mps\": [10, 0]", "[53, 0], \"velocity_mps\": [19.5, 0]");
  folder.write("two.json", crossing);
  const fs::path out = folder.path() / "out";
  const auto result =
      tests::run_fanbeam("track " + tests::quoted(folder.path() / "two.json") +
                         " --range-only --noise-figure 10 -o " + tests::quoted(out));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("exchanged with probability") != std::string::npos);
  CHECK(result.output.find("exists with probability") != std::string::npos);
  const auto record = nlohmann::json::parse(tests::results(out).at("run.json"));
  CHECK(record["scenarios"][0]["range_only"] == true);
  CHECK(record["scenarios"][0]["noise_figure"].get<double>() == Approx(10.0));
  const auto& scenario = record["scenarios"][0];
  REQUIRE(scenario["crossings"].size() == 1);
  const double swap = scenario["crossings"][0]["swap_probability"];
  CHECK(swap >= 0.0);
  CHECK(swap < 0.05);
  for (const auto& track : scenario["tracks_at_end"])
    CHECK(track["identity_probability"].get<double>() == Approx(1.0 - swap).epsilon(1e-12));
}

TEST_CASE("track measures from samples, and refuses what does not go with it", "[track]") {
  const tests::TemporaryFolder folder;
  std::string shorter = kScenario;
  shorter.replace(shorter.find("\"duration_s\": 1.0"), 17, "\"duration_s\": 0.2");
  folder.write("two.json", shorter);
  const std::string words = "track " + tests::quoted(folder.path() / "two.json") +
                            " --samples -o " + tests::quoted(folder.path() / "out");
  const auto result = tests::run_fanbeam(words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  const auto record = nlohmann::json::parse(tests::results(folder.path() / "out").at("run.json"));
  CHECK(record["from_samples"] == true);
  CHECK(record["scenarios"][0]["confirmed_tracks"] == 2);
  CHECK(record["scenarios"][0]["range_rmse_m"] < 0.01);
  CHECK(record["scenarios"][0]["beyond_samples"] == 0);
  // A car beyond what 1 GHz shows in these samples was lost in silence.
  folder.write("wide.json",
               std::string(shorter).replace(
                   shorter.find("\"duration_s\""), 12,
                   "\"radar_overrides\": {\"sweep_bandwidth_hz\": 4e9}, \"duration_s\""));
  const auto wide = tests::run_fanbeam("track " + tests::quoted(folder.path() / "wide.json") +
                                       " --samples -o " + tests::quoted(folder.path() / "wide"));
  INFO(wide.output);
  CHECK(wide.output.find("W-FOLDED") != std::string::npos);
  CHECK(tests::run_fanbeam(words + " --waveform two-slopes").exit_code == 2);
  CHECK(tests::run_fanbeam(words + " --range-only").exit_code == 2);
}

TEST_CASE("track --study --samples draws the families from samples", "[track]") {
  const tests::TemporaryFolder folder;
  folder.write("two.json", kScenario);
  const auto result =
      tests::run_fanbeam("track " + tests::quoted(folder.path() / "two.json") +
                         " --study --samples --draws 1 -o " + tests::quoted(folder.path() / "out"));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  CHECK(result.output.find("stop and go\n") != std::string::npos);  // told once it is done
  const std::string page = tests::bytes_of(folder.path() / "out" / "study.md");
  CHECK(page.find("| family, 1 draws from samples |") != std::string::npos);
  const std::vector<Table> tables = tables_of(page);
  REQUIRE(tables.size() == 1);
  check_families(tables[0], 1, 0.48, 11.14);
}

TEST_CASE("track --study writes its seven tables and their plots, with the figures of the bounds",
          "[track]") {
  const tests::TemporaryFolder folder;
  std::string shorter = kScenario;
  shorter.replace(shorter.find("\"duration_s\": 1.0"), 17, "\"duration_s\": 0.1");
  folder.write("two.json", shorter);
  const fs::path out = folder.path() / "out";
  const std::string words =
      "track " + tests::quoted(folder.path() / "two.json") + " --study --quiet ";
  // What it varies itself is not asked for beside it.
  for (const char* studied :
       {"--waveform triangle", "--association joint", "--plots", "--run 1", "--draws 0"}) {
    INFO(studied);
    CHECK(tests::run_fanbeam(words + studied).exit_code == 2);
  }
  const auto result = tests::run_fanbeam(words + "--draws 10 -o " + tests::quoted(out));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  const std::string page = tests::bytes_of(out / "study.md");
  const std::vector<Table> tables = tables_of(page);
  REQUIRE(tables.size() == 7);
  for (const auto& table : tables)
    for (const auto& row : table) CHECK(row.size() == table[0].size());
  // Buffer: 2 to 64 ramps. One triangle of 100 runs meets the bound of its 56.45 dB, 0.249 mm, within four
  // standard deviations; the bound falls with the root of the ramps.
  REQUIRE(tables[0].size() == 2 + 6);
  CHECK(std::stod(tables[0][2][2]) == Approx(0.249).margin(0.001).epsilon(0.0));
  CHECK(std::stod(tables[0][4][2]) == Approx(0.249 / 2.0).margin(0.001).epsilon(0.0));
  CHECK(std::stod(tables[0][2][1]) == Approx(0.249).epsilon(0.28));
  // Noise figures up to 50 dB, where peaks are wrong.
  REQUIRE(tables[1].size() == 2 + 11);
  CHECK(std::stod(tables[1].back()[6]) > 0.0);
  CHECK(std::stod(tables[1][2][6]) == 0.0);
  // Without a road 400 ranges of 60 to 140 m meet their bound, whose square goes with the fourth power
  // of range: 0.249 mm at 100 m, the root of the mean of (R / 100)^4 there is 1.16. Two rays that may cancel
  // make it worse whatever the noise.
  REQUIRE(tables[2].size() == 2 + 9);
  CHECK(std::stod(tables[2][4][1]) == Approx(0.249 * 1.16).epsilon(0.15));
  for (const std::size_t row : {2U, 3U, 4U, 5U})
    CHECK(std::stod(tables[2][row][3]) > 5.0 * std::stod(tables[2][row][1]));
  // Six targets: pairs in order miss two in three, two stages hardly any.
  REQUIRE(tables[3].size() == 2 + 6);
  CHECK(std::stod(tables[3][4][1]) == Approx(66.0).margin(6.0).epsilon(0.0));
  CHECK(std::stod(tables[3][4][5]) <= 1.0);
  // Five waveforms with two associations, and one row from samples; no identity is exchanged.
  REQUIRE(tables[4].size() == 2 + 11);
  for (std::size_t i = 2; i < tables[4].size(); ++i) CHECK(std::stoi(tables[4][i][6]) == 0);
  check_families(tables[5], 10, 2.44, 5.93);
  // Swaps happen as often as 2 p (1 - p) says: 20000 draws, four standard deviations.
  REQUIRE(tables[6].size() == 2 + 9);
  for (std::size_t i = 2; i < tables[6].size(); ++i)
    CHECK(std::stod(tables[6][i][3]) ==
          Approx(std::stod(tables[6][i][1])).margin(0.0128).epsilon(0.0));
  for (const char* plot : {"buffer", "noise-figure", "reflections-range", "reflections-speed",
                           "missed", "ghosts", "families-mota", "families-nees", "crossing"}) {
    CHECK(page.find("](" + std::string(plot) + ".png)") != std::string::npos);
    for (const char* ending : {".png", ".svg"})
      CHECK(fs::file_size(out / (plot + std::string(ending))) > 1000);
  }
}
