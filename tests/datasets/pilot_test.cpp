// What a campaign's runs draw, which of them a few stand for, and what those tell of all.
#include "datasets/pilot.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "datasets/draw.h"
#include "datasets/ledger.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;

namespace {

namespace fs = std::filesystem;

datasets::Campaign campaign_in(const tests::TemporaryFolder& folder, const std::string& scene,
                               const std::string& parameters) {
  core::ProblemList problems;
  datasets::Campaign campaign = datasets::read_campaign(
      folder.write("campaign.toml",
                   "[campaign]\nname = \"x\"\nscenes = [\"" + scene +
                       "\"]\nplan = \"grid\"\nruns = 1\nframes = { count = 1 }\n"
                       "products = [\"power\"]\nsamples_per_cell = 0.3\nisa = \"v2\"\n"
                       "[parameters]\n" +
                       parameters),
      problems);
  problems.throw_if_errors();
  return campaign;
}

datasets::PilotFigures flown(const datasets::Campaign& campaign) {
  return datasets::fly_pilot(campaign, datasets::drawn_of(campaign), {{}, FANBEAM_SOURCE_DIR, {}});
}

}  // namespace

TEST_CASE(
    "Runs of which the draw is refused are counted by what is wrong, and not among the others",
    "[pilot]") {
  const tests::TemporaryFolder folder;
  // Fog below -40 C is refused: a third of six.
  const datasets::Campaign campaign =
      campaign_in(folder, "flat-grass",
                  "surface = { values = [\"dry\", \"wet\"] }\nweather.visibility_m = 200\n"
                  "weather.temperature_C = { values = [10, -50, 0] }\n");
  REQUIRE(campaign.runs == 6);
  const datasets::Drawn drawn = datasets::drawn_of(campaign);
  CHECK(drawn.runs == 4);
  REQUIRE(drawn.scenes.size() == 1);
  CHECK(drawn.scenes.at("flat-grass").count() == 4);
  datasets::Drawer drawer(campaign);
  int first = 0;
  while (drawer.draw(first).number("weather.temperature_C") != -50.0) ++first;
  REQUIRE(drawn.refused.size() == 1);
  const datasets::Drawn::Refusal& refusal = drawn.refused.begin()->second;
  CHECK(refusal.run == first);
  CHECK(refusal.count == 2);
  CHECK_THAT(
      refusal.why,
      Catch::StartsWith("E-RANGE temperature_C = -50: expected -40 to 50 C where there is fog"));
  for (std::size_t i = 0; i < 8; ++i) {
    const int run = drawn.scenes.at("flat-grass").pick(i, 4);
    CHECK(drawer.draw(run).number("weather.temperature_C") != -50.0);
  }
  // What the file says, whatever becomes of it.
  const datasets::Drawn::Range& range = drawn.ranges.at("weather.temperature_C");
  CHECK(range.low == -50.0);
  CHECK(range.high == 10.0);
  CHECK(drawn.ranges.at("surface").words == std::map<std::string, int>{{"dry", 3}, {"wet", 3}});
}

TEST_CASE("Runs of a scene are picked spread over all of them, then in turn", "[pilot]") {
  datasets::SceneRuns many;
  for (int run = 0; run < 1000; ++run) many.add(run);
  CHECK(many.count() == 1000);
  // Every 16th is kept, 0 to 992: of these 63 the 7th, 23rd, 39th and 55th, counted from 0.
  CHECK(many.kept() == 63);
  std::vector<int> picked;
  for (std::size_t i = 0; i < 6; ++i) picked.push_back(many.pick(i, 4));
  CHECK(picked == std::vector<int>{112, 368, 624, 880, 64, 80});
  datasets::SceneRuns few;
  for (const int run : {5, 7, 9}) few.add(run);
  picked.clear();
  for (std::size_t i = 0; i < 6; ++i) picked.push_back(few.pick(i, 4));
  CHECK(picked == std::vector<int>{5, 7, 9, 5, 7, 9});
}

TEST_CASE("A pilot whose first run is refused tells the time of opening all the same", "[pilot]") {
  const tests::TemporaryFolder folder;
  fs::create_directory(folder.path() / "cold");
  std::ostringstream scene;
  scene << std::ifstream(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml").rdbuf()
        << "\n[weather]\ntemperature_C = -45.0\n";
  folder.write("cold/scene.toml", scene.str());
  // The draws are good, but fog is refused in air as cold as the scene's.
  const datasets::PilotFigures pilot =
      flown(campaign_in(folder, "cold", "weather.liquid_water_g_per_m3 = { values = [0.1, 0] }\n"));
  CHECK(pilot.scenes == 1);
  CHECK(pilot.runs == 3);
  CHECK(pilot.run_s > 0.0);
  CHECK(pilot.run_bytes > 1e4);
  CHECK(pilot.open_s > 0.0);
  REQUIRE(pilot.refused.size() == 1);
  CHECK(pilot.refused[0].run == 0);
  CHECK(pilot.refused[0].scene == "cold");
  CHECK_THAT(pilot.refused[0].why, Catch::StartsWith("E-RANGE temperature_C = -45"));
}

TEST_CASE("A pilot of nothing that flies says why, once", "[pilot]") {
  const tests::TemporaryFolder folder;
  const datasets::PilotFigures nowhere =
      flown(campaign_in(folder, "flat-gras", "weather.humidity = { values = [0.4, 0.5] }\n"));
  CHECK(nowhere.runs == 0);
  CHECK(nowhere.scenes == 0);
  CHECK(nowhere.open_s == 0.0);
  REQUIRE(nowhere.refused.size() == 1);
  CHECK_THAT(nowhere.refused[0].why, Catch::Contains("flat-gras"));
  // All draws are refused: told by them already.
  const datasets::PilotFigures none = flown(campaign_in(
      folder, "flat-grass", "weather.visibility_m = 200\nweather.temperature_C = -50\n"));
  CHECK(none.runs == 0);
  CHECK(none.refused.empty());
}

TEST_CASE("A pilot tells what is odd in the runs that it makes, once", "[pilot]") {
  const tests::TemporaryFolder folder;
  const datasets::PilotFigures warm = flown(campaign_in(
      folder, "flat-grass",
      "weather.snow_rate_mm_per_h = { values = [1, 3] }\nweather.temperature_C = 30\n"));
  CHECK(warm.refused.empty());
  REQUIRE(warm.warnings.size() == 1);
  CHECK(warm.warnings[0].code == "W-WARM-SNOW");
}

TEST_CASE("A shard is every N-th of the runs from the K-th on", "[pilot]") {
  const std::vector<int> runs = {3, 4, 5, 10, 11, 12, 20};
  CHECK(datasets::shard_of(runs, "", "--shard") == runs);
  CHECK(datasets::shard_of(runs, "1/1", "--shard") == runs);
  CHECK(datasets::shard_of(runs, "2/3", "--shard") == std::vector<int>{4, 11});
  CHECK(datasets::shard_of(runs, "3/3", "--shard") == std::vector<int>{5, 12});
  CHECK(datasets::shard_of(runs, "9/9", "--shard").empty());
  for (const char* text : {"3", "0/3", "4/3", "1.5/3", "1/2.5", "/", "a/3", "1/nan", "1/1e7"}) {
    INFO(text);
    CHECK_THROWS_WITH(datasets::shard_of(runs, text, "--shard"),
                      Catch::Contains("E-RANGE --shard = \"" + std::string(text) +
                                      "\": expected K/N with K from 1 to N, such as 3/8"));
  }
}
