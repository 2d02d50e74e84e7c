// fanbeam doctor as a user meets it: table, JSON, exit codes.
#include <algorithm>
#include <regex>

#include "tests/apps/busy_scene.h"
#include "tests/apps/plain_scene.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

const std::string kBuried = R"([[target]]
name = "buried"
at = { latitude_deg = 52.01, longitude_deg = 10.0 }
above_ground_m = -3.0
rcs = { shape = "constant", rcs_dBsm = 0.0 }
)";

}  // namespace

TEST_CASE("doctor tells the worst first, at most 100 columns wide, and writes the same as JSON",
          "[doctor]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", kPlainOverGrass + kBuried);
  const fs::path file = folder.path() / "findings.json";
  const Result result =
      run_fanbeam("doctor " + quoted(folder.path()) + " --accuracy 0.1 --json " + quoted(file));
  INFO(result.output);
  CHECK(result.exit_code == 1);  // something is wrong
  CHECK(result.output.starts_with("wrong     target-below-ground: 3 m\n"));
  CHECK(result.output.find("plain: 1 wrong, 2 delicate, 0 to note") != std::string::npos);
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);

  const nlohmann::json json = json_of(file);
  CHECK(json["scene"] == "plain");
  CHECK(json["accuracy_grey"] == 0.1);
  std::vector<std::string> found;
  for (const nlohmann::json& finding : json["findings"]) {
    found.push_back(finding["severity"].get<std::string>() + " " +
                    finding["check"].get<std::string>());
    for (const char* key : {"what", "where", "why", "do"})
      CHECK_FALSE(finding[key].get<std::string>().empty());
    CHECK(finding["figure"].is_number());
  }
  CHECK(found == std::vector<std::string>{"wrong target-below-ground", "delicate beyond-terrain",
                                          "delicate accuracy-below-grey-step"});
  CHECK(json["findings"][0]["figure"].get<double>() == Approx(3.0));
  CHECK(json["findings"][0]["unit"] == "m");
}

TEST_CASE("doctor exits with 0 when nothing is worse than delicate, with 3 for bad input",
          "[doctor]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", kPlainOverGrass);
  const Result delicate = run_fanbeam("doctor " + quoted(folder.path()));
  INFO(delicate.output);
  CHECK(delicate.exit_code == 0);
  CHECK(delicate.output.find("delicate  beyond-terrain") != std::string::npos);
  CHECK(run_fanbeam("doctor flat-grass").output == "flat-grass: 0 wrong, 0 delicate, 0 to note\n");
  folder.write("scene.toml", kPlainOverGrass + "nonsense = 1\n");
  CHECK(run_fanbeam("doctor " + quoted(folder.path())).exit_code == 3);
  CHECK(run_fanbeam("doctor flat-grass --accuracy no").exit_code == 2);
}

TEST_CASE("doctor tells an approach's height, offset and glide angle, with units and its runway",
          "[doctor]") {
  const std::string runway =
      "[[runway]]\nfirst = { name = \"36\", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m "
      "= "
      "0.0 }\nsecond = { name = \"18\", latitude_deg = 52.009, longitude_deg = 10.0, elevation_m = "
      "0.0 }\n[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0\n";
  const TemporaryFolder folder;
  folder.write("scene.toml",
               kPlainOverGrass.substr(0, kPlainOverGrass.find("[trajectory")) + runway);
  const fs::path file = folder.path() / "findings.json";
  const Result result = run_fanbeam("doctor " + quoted(folder.path()) + " --json " + quoted(file));
  INFO(result.output);
  CHECK(result.output.find("approach  runway 36: 15.0 m over the threshold, 0.0 m ") !=
        std::string::npos);
  CHECK(std::regex_search(result.output, std::regex("glide angle 3\\.00\\s+deg")));
  const nlohmann::json approach = json_of(file)["approach"];
  CHECK(approach["runway"] == "36");
  CHECK(approach["glide_angle_deg"].get<double>() == Approx(3.0).epsilon(0.0).margin(0.01));
  CHECK(approach["height_over_threshold_m"].get<double>() ==
        Approx(15.0).epsilon(0.0).margin(0.05));
  folder.write("scene.toml", kPlainOverGrass);
  run_fanbeam("doctor " + quoted(folder.path()) + " --json " + quoted(file));
  CHECK(json_of(file)["approach"].is_null());
}

TEST_CASE("doctor --measure tells the error that render reaches, where it is too large",
          "[doctor]") {
  const TemporaryFolder folder;
  write_busy_scene(folder, 20);
  std::string by_rays = busy_scene();  // slices reach what rays do not
  by_rays.insert(by_rays.find("realisation = "), "caster = \"rays\"\n");
  folder.write("scene.toml", by_rays);
  const fs::path file = folder.path() / "findings.json";
  const auto not_reached = [&](const std::string& accuracy_grey) {
    const Result result = run_fanbeam("doctor " + quoted(folder.path()) + " --measure --accuracy " +
                                      accuracy_grey + " --json " + quoted(file));
    INFO(result.output);
    CHECK(result.exit_code == 0);
    nlohmann::json found;
    const nlohmann::json told = json_of(file);
    for (const nlohmann::json& finding : told["findings"])
      if (finding["check"] == "accuracy-not-reached") found = finding;
    return found;
  };
  const nlohmann::json finding = not_reached("0.01");
  REQUIRE(finding.is_object());
  CHECK(finding["severity"] == "delicate");
  CHECK(finding["unit"] == "grey levels");
  // Half of the accuracy is for sampling.
  CHECK(finding["what"].get<std::string>().find("of 3 frames miss the 0.005 grey levels") !=
        std::string::npos);
  CHECK(finding["figure"].get<double>() > 0.005);
  const std::string where = finding["where"];
  REQUIRE(where.starts_with("frame "));
  const auto rendered_grey = [&](const std::string& accuracy_grey) {
    const fs::path out = folder.path() / ("out" + accuracy_grey);
    const Result result =
        run_fanbeam("render " + quoted(folder.path()) + " -q -o " + quoted(out) + " --frames " +
                    where.substr(6) + " --accuracy " + accuracy_grey);
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    return json_of(out / "run.json")["frames"][0]["estimated_error_grey"].get<double>();
  };
  CHECK(rendered_grey("0.01") == Approx(finding["figure"].get<double>()).epsilon(1e-9));

  CHECK(not_reached("4").is_null());
  CHECK(rendered_grey("4") <= 2.0);
}
