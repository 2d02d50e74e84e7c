// --accuracy, --time-budget and --estimate-error as a user meets them.
#include <algorithm>

#include "core/image.h"
#include "tests/apps/program.h"

using namespace fanbeam::tests;
namespace core = fanbeam::core;
namespace fs = std::filesystem;

namespace {

const std::string kPictures = " -q --products bscope,cscope,power ";
const char* const kCasters[] = {"rays", "profile"};

Result render_obstacles(const fs::path& folder, const std::string& words) {
  return render("obstacle-field", folder, words);
}

// Four columns: a ladder of samplings is then quickly climbed.
std::string narrow_view(const TemporaryFolder& folder) {
  return " --sensor " + quoted(folder.write("narrow.toml", narrow_sensor(4))) + " ";
}

// Files of pictures with their bytes.
std::map<std::string, std::string> pictures(const fs::path& folder) {
  std::map<std::string, std::string> files = results(folder);
  files.erase("run.json");
  return files;
}

double samples(const nlohmann::json& frame) {
  return frame["rays"].get<double>() + frame["slices"].get<double>();
}

}  // namespace

TEST_CASE("--accuracy gives the same bytes for any number of threads and choice of frames",
          "[accuracy]") {
  const TemporaryFolder folder;
  for (const std::string caster : kCasters) {
    INFO(caster);
    const std::string words = kPictures + "--accuracy 0.3 --caster " + caster;
    const fs::path together = folder.path() / (caster + "-1");
    render_obstacles(together, words + kThreeFrames + "--threads 1");
    const auto first = results(together);
    CHECK(first.size() >= 9);
    render_obstacles(folder.path() / (caster + "-2"), words + kThreeFrames + "--threads 2");
    CHECK((results(folder.path() / (caster + "-2")) == first));
    const nlohmann::json frames = json_of(together / "run.json")["frames"];
    for (const auto& [frame, index] :
         std::vector<std::pair<std::string, int>>{{"140", 2}, {"120", 1}}) {
      INFO("frame " << frame);
      const fs::path alone = folder.path() / (caster + frame);
      render_obstacles(alone, words + " --frames " + frame);
      CHECK(json_of(alone / "run.json")["frames"][0] == frames[static_cast<std::size_t>(index)]);
      for (const auto& [name, bytes] : pictures(alone))
        CHECK((bytes.empty() || bytes == bytes_of(together / name)));
    }
  }
}

TEST_CASE("--accuracy leaves at most half of its error to sampling, and more of it is cheaper",
          "[accuracy]") {
  const TemporaryFolder folder;
  for (const std::string caster : kCasters) {
    std::vector<nlohmann::json> runs;
    for (const double accuracy_grey : {2.0, 0.2, 0.12}) {
      INFO(caster << " to " << accuracy_grey);
      const std::string asked = nlohmann::json(accuracy_grey).dump();
      const Result result =
          render_obstacles(folder.path() / "out", "--products bscope,cscope --accuracy " + asked +
                                                      kThreeFrames + "--caster " + caster);
      CHECK(result.output.find("sampling error at most 0.") != std::string::npos);
      CHECK(result.output.find(" grey RMS (estimated), asked for ") != std::string::npos);
      CHECK(result.output.find("missed") == std::string::npos);
      const nlohmann::json run = json_of(folder.path() / "out/run.json");
      CHECK(run["sampling"]["refined_to_grey"] == accuracy_grey / 2.0);
      REQUIRE(run["frames"].size() == 3);
      for (const nlohmann::json& frame : run["frames"]) {
        CHECK(frame["estimated_error_grey"] > 0.0);
        CHECK(frame["estimated_error_grey"] <= accuracy_grey / 2.0);
        CHECK(frame["estimated_error_cscope_grey"] <= accuracy_grey / 2.0);
        CHECK(frame["levels"] >= 2);
      }
      runs.push_back(run["frames"]);
    }
    INFO(caster);
    // Slices of one frame come down so fast that two accuracies may take the same.
    const bool rays = caster == "rays";
    for (std::size_t i = 0; i < runs.front().size(); ++i) {
      CHECK(samples(runs.back()[i]) > samples(runs.front()[i]));
      for (std::size_t finer = 1; finer < runs.size(); ++finer)
        CHECK(samples(runs[finer][i]) >= samples(runs[finer - 1][i]) + (rays ? 1.0 : 0.0));
    }
  }
}

TEST_CASE("What a time budget chose gives the same bytes by --rays-per-cell", "[accuracy]") {
  const TemporaryFolder folder;
  const std::string sensor = narrow_view(folder);
  for (const std::string caster : kCasters) {
    const std::string words = kPictures + "--frames 120 --caster " + caster + sensor;
    // All the time there is, some, and next to none.
    for (const std::string budget_ms : {"1e6", "5", "0.1"}) {
      INFO(caster << " within " << budget_ms << " ms");
      const fs::path chosen = folder.path() / "chosen", told = folder.path() / "told";
      fs::remove_all(chosen);
      fs::remove_all(told);
      render_obstacles(chosen, words + "--time-budget " + budget_ms);
      nlohmann::json run = json_of(chosen / "run.json");
      const nlohmann::json budget = run["time_budget"];
      CHECK(budget["budget_ms"] == std::stod(budget_ms));
      CHECK(budget["estimated_error_grey"] > 0.0);
      if (budget_ms == "1e6") CHECK(budget["rays_per_cell"] == 64.0);  // the finest of the ladder
      if (budget_ms == "1e6") CHECK(budget["fits"] == true);
      render_obstacles(told, words + "--rays-per-cell " + budget["rays_per_cell"].dump());
      CHECK(pictures(chosen).size() == 6);  // with their folders
      CHECK((pictures(chosen) == pictures(told)));
      run.erase("time_budget");
      CHECK(run == json_of(told / "run.json"));
    }
  }
}

TEST_CASE("A time budget that nothing meets takes the coarsest sampling and says so",
          "[accuracy]") {
  const TemporaryFolder folder;
  for (const auto& [caster, coarsest] :
       std::vector<std::pair<std::string, double>>{{"rays", 0.5}, {"profile", 0.3}}) {
    INFO(caster);
    const Result result = render_obstacles(folder.path() / "out",
                                           "--time-budget 0.1 --frames 120 --caster " + caster);
    CHECK(result.output.find(" ms of 0.1 ms a frame, sampling error ") != std::string::npos);
    CHECK(result.output.find("--rays-per-cell " + std::string(caster == "rays" ? "0.5" : "0.3") +
                             " (the coarsest there is, and too slow)") != std::string::npos);
    const nlohmann::json budget = json_of(folder.path() / "out/run.json")["time_budget"];
    CHECK(budget["fits"] == false);
    CHECK(budget["rays_per_cell"] == coarsest);
  }
}

TEST_CASE("Time and accuracy together: the coarsest sampling that is accurate enough",
          "[accuracy]") {
  const TemporaryFolder folder;
  const std::string sensor = narrow_view(folder);
  for (const std::string caster : kCasters) {
    double before = 0.0;
    for (const double accuracy_grey : {20.0, 1.0, 0.5}) {
      INFO(caster << " to " << accuracy_grey);
      render_obstacles(folder.path() / "out",
                       "-q --products bscope,cscope --frames 120 --time-budget 1e6 "
                       "--accuracy " +
                           nlohmann::json(accuracy_grey).dump() + " --caster " + caster + sensor);
      const nlohmann::json budget = json_of(folder.path() / "out/run.json")["time_budget"];
      CHECK(budget["fits"] == true);
      CHECK(budget["estimated_error_grey"] <= accuracy_grey / 2.0);
      CHECK(budget["rays_per_cell"] >= before);
      before = budget["rays_per_cell"];
      if (accuracy_grey > 10.0) CHECK(before == (caster == "rays" ? 0.5 : 0.3));
    }
    CHECK(before > 1.0);
    CHECK(before < 64.0);
  }
}

TEST_CASE("A time budget with an accuracy is repeated by --rays-per-cell with that accuracy",
          "[accuracy]") {
  const TemporaryFolder folder;
  const std::string words =
      kPictures + "--frames 120 --caster rays --accuracy 4" + narrow_view(folder);
  const fs::path chosen = folder.path() / "chosen", told = folder.path() / "told";
  render_obstacles(chosen, words + " --time-budget 1e6");
  const nlohmann::json budget = json_of(chosen / "run.json")["time_budget"];
  render_obstacles(told, words + " --rays-per-cell " + budget["rays_per_cell"].dump());
  CHECK((pictures(chosen) == pictures(told)));
}

TEST_CASE("Ways to sample that contradict each other, and no numbers, are usage errors",
          "[accuracy]") {
  const TemporaryFolder folder;
  for (const auto& [words, named] : std::vector<std::pair<std::string, std::string>>{
           {"--accuracy 1 --reference", "--accuracy"},
           {"--accuracy 1 --estimate-error", "--accuracy"},
           {"--time-budget 50 --rays-per-cell 4", "--time-budget"},
           {"--time-budget 50 --reference", "--time-budget"},
           {"--time-budget 50 --estimate-error", "--time-budget"},
           {"--estimate-error --reference", "--estimate-error"},
           {"--accuracy 0", "--accuracy"},
           {"--accuracy -1", "--accuracy"},
           {"--accuracy nan", "--accuracy"},
           {"--accuracy inf", "--accuracy"},
           {"--accuracy fine", "--accuracy"},
           {"--time-budget 0", "--time-budget"},
           {"--time-budget nan", "--time-budget"},
           {"--time-budget inf", "--time-budget"},
           {"--rays-per-cell nan", "--rays-per-cell"}}) {
    INFO(words);
    const Result refused =
        run_fanbeam("render flat-grass " + words + " -o " + quoted(folder.path() / "out"));
    INFO(refused.output);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.find(named) != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path() / "out"));
  }
  CHECK(run_fanbeam("plan flat-grass --accuracy nan").exit_code == 2);
  CHECK(run_fanbeam("atmosphere --frequency 35 --height nan").exit_code == 2);
}

TEST_CASE("--resume takes the estimated errors of finished frames over", "[accuracy]") {
  const TemporaryFolder folder;
  for (const std::string caster : kCasters) {
    INFO(caster);
    const fs::path out = folder.path() / caster;
    const std::string words =
        "--resume --products bscope,cscope --caster " + caster + kThreeFrames + "--accuracy ";
    const std::string summary = "sampling error at most ";
    const auto told = [&](const std::string& output) {
      const std::size_t at = output.find(summary);
      REQUIRE(at != std::string::npos);
      return output.substr(at, output.find('\n', at) - at);
    };
    const std::string first_told = told(render_obstacles(out, words + "0.3").output);
    const auto first = results(out);
    const Result all = render_obstacles(out, words + "0.3");
    CHECK(all.output.find("(3 already there)") != std::string::npos);
    CHECK(told(all.output) == first_told);
    CHECK((results(out) == first));
    fs::remove(out / "cscope/00120.png");
    CHECK(render_obstacles(out, words + "0.3").output.find("(2 already there)") !=
          std::string::npos);
    CHECK((results(out) == first));
    // Frames of another accuracy are others.
    CHECK(render_obstacles(out, words + "0.4").output.find("already there") == std::string::npos);
  }
}

TEST_CASE("--estimate-error tells the error and leaves the pictures alone", "[accuracy]") {
  const TemporaryFolder folder;
  for (const std::string caster : kCasters) {
    const std::string words = kPictures + kThreeFrames + "--rays-per-cell 2 --caster " + caster;
    const fs::path plain = folder.path() / (caster + "-plain");
    const fs::path estimated = folder.path() / (caster + "-estimated");
    render_obstacles(plain, words);
    render_obstacles(estimated, words + " --estimate-error");
    const nlohmann::json without = json_of(plain / "run.json")["frames"];
    const nlohmann::json with = json_of(estimated / "run.json")["frames"];
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(without[i]["estimated_error_grey"].is_null());
      CHECK(with[i]["estimated_error_grey"] > 0.0);
      CHECK(with[i]["estimated_error_grey"] < 5.0);
    }
    for (const auto& [name, bytes] : pictures(plain)) {
      if (bytes.empty()) continue;  // a folder
      INFO(caster << " " << name);
      CHECK((core::read_image(plain / name).layers.at(0).values ==
             core::read_image(estimated / name).layers.at(0).values));
    }
  }
}

TEST_CASE("A scene's grey_levels is --accuracy, its time_budget_ms --time-budget", "[accuracy]") {
  const TemporaryFolder folder;
  folder.write("few.toml", narrow_sensor(2));
  const auto scene_with = [&](const std::string& accuracy) {
    folder.write("scene.toml",
                 "[scene]\nname = \"t\"\norigin = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
                 "vertical_datum = \"scene\"\n[terrain]\nhalf_extent_m = 1000.0\n"
                 "spacing_m = 100.0\n[sensor]\nfile = \"few.toml\"\n" +
                     accuracy +
                     "[trajectory.fixed]\nat = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
                     "above_ground_m = 60.0\n");
  };
  const auto rendered = [&](const std::string& words) {
    const fs::path out = folder.path() / "out";
    const Result result = run_fanbeam("render " + quoted(folder.path()) + " -o " + quoted(out) +
                                      " --overwrite -q --products power " + words);
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    return std::pair{json_of(out / "run.json"),
                     core::read_image(out / "power/00000.exr").layers.at(0).values};
  };

  scene_with("");
  const auto by_option = rendered("--accuracy 0.2");
  scene_with("[accuracy]\ngrey_levels = 0.2\n");
  const auto by_scene = rendered("");
  CHECK(by_scene.first["sampling"]["refined_to_grey"] == 0.1);
  CHECK(by_scene.first["sampling"] == by_option.first["sampling"]);
  CHECK(by_scene.first["plan"] == by_option.first["plan"]);
  CHECK(by_scene.second == by_option.second);
  CHECK(rendered("--accuracy 0.4").first["sampling"]["refined_to_grey"] == 0.2);
  CHECK_FALSE(rendered("--rays-per-cell 2").first["sampling"].contains("refined_to_grey"));
  CHECK_FALSE(rendered("--reference").first["sampling"].contains("refined_to_grey"));
  const Result plan = run_fanbeam("plan --json " + quoted(folder.path()));
  CHECK(nlohmann::json::parse(plan.output)["accuracy"]["grey"] == 0.2);

  scene_with("[accuracy]\ntime_budget_ms = 5000\n");
  CHECK(rendered("").first["time_budget"]["budget_ms"] == 5000.0);
  CHECK(rendered("--time-budget 4000").first["time_budget"]["budget_ms"] == 4000.0);
  CHECK_FALSE(rendered("--rays-per-cell 2").first.contains("time_budget"));

  scene_with("[accuracy]\ntime_budget_ms = 5000\nrays_per_cell = 0.2\n");
  const Result wrong = run_fanbeam("validate " + quoted(folder.path()));
  CHECK(wrong.exit_code == 3);
  for (const char* part : {"one of the two", "0, or 0.3 to 10000"})
    CHECK(wrong.output.find(part) != std::string::npos);
}
