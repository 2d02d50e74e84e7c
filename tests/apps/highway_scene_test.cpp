// The shipped motorway: vehicles that move by the laws of a road scenario, through beat signals.
#include <algorithm>
#include <cmath>

#include "core/highway.h"
#include "scenes/highway_reader.h"
#include "tests/apps/program.h"

using namespace fanbeam;

TEST_CASE("The shipped motorway shows its vehicles where the scenario has them", "[fmcw]") {
  // Frame 30, at 1.525 s: one changes lane, one brakes.
  const tests::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const auto run = tests::run_fanbeam(
      "fmcw highway-76ghz --frames 30 --products detections --quiet -o " + tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const auto file = scenes::read_highway_file(std::filesystem::path(FANBEAM_SOURCE_DIR) /
                                              "scenes/highway-76ghz/traffic.json");
  const core::HighwayScenario& scenario = file.scenarios.at(0);
  const auto list =
      nlohmann::json::parse(tests::bytes_of(out / "detections/00030.json"))["detections"];
  int looked_at = 0;
  for (const core::HighwayTarget& target : scenario.targets) {
    const core::HighwayTruth truth =
        truth_at(target, scenario.radar_speed_mps, file.radar, 30.5 * 0.05);
    // Beyond 16 m/s speeds fold: the oncoming car. The one that overtakes runs in the folded ground.
    if (target.id == "E" || target.id == "B") continue;
    ++looked_at;
    const auto seen = std::any_of(list.begin(), list.end(), [&](const auto& one) {
      return std::abs(one["range_m"].template get<double>() - truth.range_m) < 0.6 &&
             std::abs(one["radial_speed_mps"].template get<double>() - truth.range_rate_mps) <
                 0.13 &&
             std::abs(one["azimuth_rad"].template get<double>() - truth.azimuth_rad) < 0.035;
    });
    INFO(target.id << " at " << truth.range_m << " m, " << truth.range_rate_mps << " m/s, "
                   << truth.azimuth_rad << " rad");
    CHECK(seen);
  }
  CHECK(looked_at == 4);
}
