// What a worker holds of the scenes that its runs fly.
#include "datasets/worker.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/files.h"
#include "datasets/draw.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

// Four runs, in turn of two scenes beside the campaign's file.
class TwoScenes {
 public:
  TwoScenes() {
    for (const char* name : {"one", "two"}) {
      fs::create_directory(folder_.path() / name);
      fs::copy_file(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml", scene(name));
    }
    core::ProblemList problems;
    campaign_ = datasets::read_campaign(
        folder_.write("campaign.toml",
                      "[campaign]\nname = \"x\"\nscenes = [\"two\", \"one\"]\nplan = \"grid\"\n"
                      "runs = 2\nframes = { count = 1 }\nproducts = [\"power\"]\n"
                      "samples_per_cell = 0.3\nisa = \"v2\"\n"),
        problems);
    problems.throw_if_errors();
  }
  fs::path scene(const std::string& name) const { return folder_.path() / name / "scene.toml"; }
  const datasets::Campaign& campaign() const { return campaign_; }
  datasets::WorkerSettings settings() const {
    return {folder_.path() / "out", FANBEAM_SOURCE_DIR, {}, true};
  }

 private:
  tests::TemporaryFolder folder_;
  datasets::Campaign campaign_;
};

}  // namespace

TEST_CASE("Runs by scene are all runs, those of a scene one after the other as they came",
          "[worker]") {
  const TwoScenes two;
  datasets::Drawer drawer(two.campaign());
  for (int run = 0; run < 4; ++run)
    REQUIRE(scene_of(two.campaign(), drawer.draw(run)) == (run % 2 == 0 ? "two" : "one"));
  CHECK(datasets::by_scene(two.campaign(), {0, 1, 2, 3}) == std::vector<int>{1, 3, 0, 2});
  CHECK(datasets::by_scene(two.campaign(), {3, 2}) == std::vector<int>{3, 2});
  CHECK(datasets::by_scene(two.campaign(), {}).empty());
}

// What a scene says of its own draws is not undone by a campaign that says nothing of them.
TEST_CASE("A campaign shows what each scene shows, unless it says otherwise", "[worker]") {
  const tests::TemporaryFolder folder;
  fs::create_directory(folder.path() / "drawn");
  std::string scene =
      core::read_file(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml", 1U << 20U);
  REQUIRE(scene.find("[accuracy]") == std::string::npos);
  folder.write("drawn/scene.toml", scene + "\n[accuracy]\nrealisation = \"sample\"\n");
  const auto picture = [&](const std::string& line) {
    core::ProblemList problems;
    const datasets::Campaign campaign = datasets::read_campaign(
        folder.write("campaign.toml", "[campaign]\nname = \"x\"\nscenes = [\"drawn\"]\n" + line +
                                          "frames = { count = 1 }\nproducts = [\"bscope\"]\n"
                                          "samples_per_cell = 0.3\nisa = \"v2\"\n"),
        problems);
    problems.throw_if_errors();
    const fs::path out = folder.path() / ("out" + std::to_string(line.size()));
    datasets::Worker worker(campaign, {out, FANBEAM_SOURCE_DIR, {}, true});
    REQUIRE(worker.make(0) == datasets::RunEnd::made);
    return core::read_file(out / "runs" / "000000" / "bscope" / "00000.png", 1U << 24U);
  };
  const std::string own = picture("");
  CHECK(own == picture("realisation = \"sample\"\n"));
  CHECK(own != picture("realisation = \"mean\"\n"));
}

// Such a frame is noise alone, and labels say that its runway is in sight.
TEST_CASE("A run with a frame under the ground fails and says which and how deep", "[worker]") {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  const datasets::Campaign campaign = datasets::read_campaign(
      folder.write("campaign.toml",
                   "[campaign]\nname = \"x\"\nscenes = [\"flat-grass\"]\nplan = \"grid\"\n"
                   "frames = { count = 1 }\nproducts = [\"bscope\"]\nsamples_per_cell = 0.3\n"
                   "isa = \"v2\"\n[parameters]\nflight.vertical_m = { values = [-62.5, -55] }\n"),
      problems);
  problems.throw_if_errors();
  const fs::path out = folder.path() / "out";
  datasets::Worker worker(campaign, {out, FANBEAM_SOURCE_DIR, {}, false});
  CHECK(worker.make(0) == datasets::RunEnd::failed);
  REQUIRE(worker.refused().size() == 1);
  // The scene is looked at from 60 m above a plane.
  CHECK_THAT(
      core::to_string(worker.refused()[0]),
      Catch::StartsWith("flat-grass: E-RANGE flight = frame 0 with the antenna 2.50 m inside "
                        "the ground: expected an antenna above the ground"));
  CHECK_THAT(core::read_file(datasets::failed_file(out, 0), 1U << 20U),
             Catch::Contains("2.50 m inside the ground"));
  CHECK_FALSE(fs::exists(out / "runs" / "000000"));
  CHECK(worker.make(1) == datasets::RunEnd::made);
}

// As `fanbeam render` tells them; ten thousand runs would tell the same.
TEST_CASE("Warnings of a scene and of what runs draw are told once", "[worker]") {
  const tests::TemporaryFolder folder;
  fs::create_directory(folder.path() / "own");
  folder.write("own/scene.toml",
               core::read_file(FANBEAM_SOURCE_DIR "/scenes/flat-grass/scene.toml", 1U << 20U) +
                   "\n[weather]\ntemperature_C = 30.0\nsnow_rate_mm_per_h = 3.0\n");
  const auto told = [&](const std::string& scene, const std::string& parameters) {
    core::ProblemList problems;
    const datasets::Campaign campaign = datasets::read_campaign(
        folder.write("campaign.toml", "[campaign]\nname = \"x\"\nscenes = [\"" + scene +
                                          "\"]\nplan = \"grid\"\nframes = { count = 1 }\n"
                                          "products = [\"bscope\"]\nsamples_per_cell = 0.3\n"
                                          "isa = \"v2\"\n[parameters]\n" +
                                          parameters),
        problems);
    problems.throw_if_errors();
    datasets::Worker worker(campaign, {folder.path() / "out", FANBEAM_SOURCE_DIR, {}, true});
    std::vector<std::string> texts;
    for (int run = 0; run < campaign.runs; ++run) {
      REQUIRE(worker.make(run) == datasets::RunEnd::made);
      for (const core::Problem& warning : worker.new_warnings())
        texts.push_back(core::to_string(warning));
    }
    return texts;
  };
  const std::vector<std::string> drawn =
      told("flat-grass",
           "weather.temperature_C = { values = [20, 30] }\nweather.snow_rate_mm_per_h = 3\n");
  REQUIRE(drawn.size() == 1);
  CHECK_THAT(drawn[0], Catch::StartsWith("flat-grass: W-WARM-SNOW snow_rate_mm_per_h = dry snow in "
                                         "air of 20 C"));
  const std::vector<std::string> own = told("own", "weather.humidity = { values = [0.4, 0.5] }\n");
  REQUIRE(own.size() == 1);
  CHECK_THAT(own[0], Catch::Contains("own/scene.toml:") &&
                         Catch::Contains("W-WARM-SNOW weather.snow_rate_mm_per_h"));
  CHECK(told("flat-grass", "weather.humidity = { values = [0.4, 0.5] }\n").empty());
}

// A scene whose file is gone can be flown as long as it is held, and no longer.
TEST_CASE("A worker holds the scene of its last run, and no other", "[worker]") {
  const TwoScenes two;
  datasets::Worker worker(two.campaign(), two.settings());
  CHECK(worker.make(1) == datasets::RunEnd::made);
  fs::remove(two.scene("one"));
  CHECK(worker.make(3) == datasets::RunEnd::made);
  CHECK(worker.make(0) == datasets::RunEnd::made);
  CHECK(worker.make(3) == datasets::RunEnd::failed);
  REQUIRE(worker.refused().size() == 1);
  CHECK_THAT(worker.refused()[0].value, Catch::Contains("\"one\" not found"));
}
