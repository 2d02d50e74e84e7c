// Rule 3 of the hard cases, R10 and M06, for the whole program: every byte that it leaves but
// timing.json is the same for any number of threads, again, in another process, and for a frame
// whatever was rendered before it.
#include <algorithm>

#include "tests/apps/busy_scene.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;
using Json = nlohmann::json;

Files rendered(const TemporaryFolder& folder, const std::string& words) {
  const fs::path out = folder.path() / "out";
  fs::remove_all(out);
  const Result result =
      run_fanbeam("render " + quoted(folder.path()) + " -q -o " + quoted(out) + words);
  INFO(words << '\n' << result.output);
  REQUIRE(result.exit_code == 0);
  return results(out);
}

void check_same(const Files& files, const Files& expected) {
  for (const auto& [name, bytes] : expected) {
    INFO(name);
    REQUIRE(files.contains(name));
    CHECK((files.at(name) == bytes));
  }
  CHECK(files.size() == expected.size());
}

struct Way {
  const char* what;
  std::string words;
};
const std::vector<Way> kWays = {
    {"rays", " --caster rays --rays-per-cell 2"},
    {"rays, the expected power", " --caster rays --rays-per-cell 2 --realisation mean"},
    {"slices", " --rays-per-cell 4"},
    {"rays, refined to an accuracy", " --caster rays --accuracy 4"},
    {"slices, refined to an accuracy", " --accuracy 4"},
    {"every effect, planned per frame",
     " --caster rays --rays-per-cell 1 --effects all --plan-per-frame"},
    {"with the error estimated", " --caster rays --rays-per-cell 1 --estimate-error --seed 99"},
};
const std::string kFour = " --frames 0:64:16";

}  // namespace

TEST_CASE("The busy scene is busy", "[determinism]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  const Files files = rendered(folder, kFour + kWays[0].words + kAllPictures);
  // Four frames: eight pictures, power, a mask and a table each for detections, a table of obstacles.
  CHECK(std::count_if(files.begin(), files.end(),
                      [](const auto& file) { return !file.second.empty(); }) == 4 * 11 + 1);
  std::vector<std::string> off;
  for (const Json& effect : Json::parse(files.at("run.json"))["plan"])
    if (!effect["on"].get<bool>()) off.push_back(effect["effect"]);
  INFO(Json(off).dump());
  CHECK(off.size() <= 3);
  Files other = rendered(folder, kFour + kWays[0].words + kAllPictures + " --seed 1");
  CHECK_FALSE((other.at("bscope/00016.png") == files.at("bscope/00016.png")));  // it is random
}

TEST_CASE("R10 the same bytes for threads, repetitions and processes, whatever the way",
          "[determinism][R10]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  for (const Way& way : kWays) {
    INFO(way.what);
    const std::string words = kFour + way.words + kAllPictures;
    const Files first = rendered(folder, words + " --threads 1");
    for (const char* threads : {"1", "2", "8"}) {
      INFO(threads << " threads");
      check_same(rendered(folder, words + " --threads " + threads), first);
    }
  }
}

TEST_CASE("R10 the same bytes for a frame alone, and for frames in parts", "[determinism][R10]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  for (const Way& way : kWays) {
    INFO(way.what);
    const Files together = rendered(folder, kFour + way.words + kAllPictures);
    const Json record = Json::parse(together.at("run.json"));
    for (const int frame : {48, 16}) {
      const Files alone =
          rendered(folder, " --frames " + std::to_string(frame) + way.words + kAllPictures);
      for (const auto& [name, bytes] : alone) {
        if (bytes.empty() || name == "run.json") continue;
        INFO(name);
        REQUIRE(together.contains(name));
        CHECK((together.at(name) == bytes));
      }
      const Json single = Json::parse(alone.at("run.json"));
      CHECK(single["frames"][0] == record["frames"][static_cast<std::size_t>(frame / 16)]);
      CHECK(single["plan"] == record["plan"]);
      CHECK(single["input"] == record["input"]);
    }
  }
}
