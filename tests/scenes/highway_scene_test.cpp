// Targets that move by the laws of a road scenario, and the motorway that ships.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/highway.h"
#include "scenes/highway_path.h"
#include "tests/peak_memory.h"
#include "tests/processor_time.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;

namespace {

const std::filesystem::path kHighway =
    std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes" / "highway-76ghz";

constexpr const char* kTarget = R"(
[[target]]
name = "car"
rcs = { rcs_dBsm = 10.0 }
at = { runway = "36", behind_threshold_m = 100.0, left_m = 2.0 }
above_ground_m = 0.5
highway = { file = "traffic.json", scenario = "H1", target = "D" }
)";

}  // namespace

TEST_CASE("The shipped motorway shows its vehicles where and as fast as the scenario says",
          "[shipped_scenes][highway]") {
  const tests::Outcome outcome = tests::build(kHighway, {});
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  const scenes::Scene& scene = *outcome.scene;
  CHECK(scene.frame_count() == 60);
  const auto file = scenes::read_highway_file(kHighway / "traffic.json");
  const core::HighwayScenario& scenario = file.scenarios.at(0);
  int plates = 0;
  for (const core::HighwayTarget& law : scenario.targets)
    for (const renderer::PointTarget& target : scene.world.targets) {
      if (!target.name.starts_with(law.id + ", ") || !target.name.ends_with(", plate")) continue;
      ++plates;
      for (int frame = 0; frame < scene.frame_count(); ++frame) {
        const core::Pose pose = scene.trajectory->at(scene.trajectory->frame_time_s(frame, 20.0));
        INFO(target.name << " at " << pose.time_s << " s");
        const glm::dvec3 own_m = scene.frame.to_local_m(pose.position);
        const core::Pose later = scene.trajectory->at(pose.time_s + 0.01);
        const glm::dvec3 own_mps = (scene.frame.to_local_m(later.position) - own_m) / 0.01;
        const glm::dvec3 line_m = target.position_at(pose.time_s) - own_m;
        const core::HighwayTruth truth =
            truth_at(law, scenario.radar_speed_mps, file.radar, pose.time_s);
        CHECK(glm::length(line_m) == Approx(truth.range_m).epsilon(0.0).margin(1e-6));
        // The runway leads north; azimuth to the right is to the east.
        CHECK(std::atan2(line_m.x, line_m.y) ==
              Approx(truth.azimuth_rad).epsilon(0.0).margin(1e-6));
        const double rate_mps =
            glm::dot(glm::normalize(line_m), target.velocity_at(pose.time_s) - own_mps);
        CHECK(rate_mps == Approx(truth.range_rate_mps).epsilon(0.0).margin(1e-6));
      }
    }
  CHECK(plates == 6);
}

TEST_CASE("Legs are short where a target accelerates and single where it does not", "[highway]") {
  core::HighwayTarget target;
  target.velocity_mps = {20.0, 0.0};
  CHECK(scenes::highway_times_s(target, 3.0) == std::vector<double>{-1.0, 4.0});
  target.lane_changes = {{1.0, 2.0, 3.5}};
  const auto times_s = scenes::highway_times_s(target, 3.0);
  // Half a millisecond before the change begins, one after it ends, 1 ms apart.
  REQUIRE(times_s.size() > 1000);
  CHECK(times_s.size() < 1010);
  CHECK(times_s[1] == Approx(0.9995).epsilon(0.0).margin(1e-3));
  CHECK(times_s[2] - times_s[1] == Approx(1e-3));
  target.lane_changes[0].end_s = 1e5;
  CHECK_THROWS_AS(scenes::highway_times_s(target, 1e5), core::InputError);
  // As many as there is room for leave none for more.
  target.lane_changes = {{0.0, 199.9965, 3.5}, {0.0, 199.9965, 3.5}};
  CHECK_THROWS_AS(scenes::highway_times_s(target, 300.0), core::InputError);
}

TEST_CASE(
    "R17 paths of a scenario of two million waypoints in all are E-LIMIT, and no more are made",
    "[highway][R17]") {
  const tests::TemporaryFolder folder;
  std::filesystem::copy_file(kHighway / "traffic.json", folder.path() / "traffic.json");
  // D changes its lane for 2.4 s: 2400 legs.
  std::string text = tests::kSmallScene;
  for (int i = 0; i < 2000; ++i) text += kTarget;
  const tests::PeakMemory memory;
  const tests::Outcome outcome = tests::build_text(folder, text);
  REQUIRE(outcome.problems.size() == 1);
  INFO(core::to_string(outcome.problems[0]));
  CHECK(outcome.problems[0].code == "E-LIMIT");
  CHECK(std::abs(std::stod(outcome.problems[0].field.substr(7)) - 2e6 / 2404) < 5.0);
  CHECK(memory.rise_MiB() < 1000.0 * tests::kSanitizerMemory);
}

TEST_CASE("A target of a scenario starts at its place and refuses what is not there", "[highway]") {
  const tests::TemporaryFolder folder;
  std::filesystem::copy_file(kHighway / "traffic.json", folder.path() / "traffic.json");
  const auto problems = [&](const std::string& target) {
    folder.write("scene.toml", tests::kSmallScene + target);
    const tests::Outcome outcome = tests::build(folder.path(), {});
    std::vector<std::string> codes;
    for (const core::Problem& problem : outcome.problems)
      if (problem.code[0] == 'E') codes.push_back(problem.code + " " + problem.field);
    if (codes.empty()) {
      const renderer::PointTarget& seen = outcome.scene->world.targets.back();
      // D begins 105 m ahead, 3.5 m to the right of `at`, whose runway leads north from x = y = 0.
      CHECK(seen.position_at(0.0).x == Approx(3.5 - 2.0).epsilon(0.0).margin(1e-6));
      CHECK(seen.position_at(0.0).y == Approx(205.0).epsilon(0.0).margin(1e-6));
      CHECK(seen.velocity_at(0.2).y == Approx(25.0).epsilon(0.0).margin(1e-6));
    }
    return codes;
  };
  using Codes = std::vector<std::string>;
  const std::string good = kTarget;
  CHECK(problems(good) == Codes{});
  CHECK(problems(tests::replaced(good, "\"H1\"", "\"H2\"")) ==
        Codes{"E-REF target[0].highway.scenario"});
  CHECK(problems(tests::replaced(good, "target = \"D\"", "target = \"Z\"")) ==
        Codes{"E-REF target[0].highway.target"});
  CHECK(problems(tests::replaced(good, "traffic.json", "none.json")) ==
        Codes{"E-IO target[0].highway.file"});
  CHECK(problems(tests::replaced(good, "runway = \"36\", behind_threshold_m = 100.0, left_m = 2.0",
                                 "latitude_deg = 52.0, longitude_deg = 10.0")) ==
        Codes{"E-REF target[0].at"});
  folder.write("scene.toml",
               tests::kSmallScene + tests::replaced(good, "target = \"D\"", "target = \"d1\""));
  const tests::Outcome misspelt = tests::build(folder.path(), {});
  REQUIRE(misspelt.problems.size() == 1);
  CHECK(misspelt.problems[0].expected.starts_with("a target of the scenario; there are "));
  CHECK(misspelt.problems[0].expected.find("D") != std::string::npos);
  CHECK(problems(good + "[[target.waypoint]]\ntime_s = 0.0\nat = { latitude_deg = 52.0, "
                        "longitude_deg = 10.0 }\n") == Codes{"E-REF target[0].highway"});
}
