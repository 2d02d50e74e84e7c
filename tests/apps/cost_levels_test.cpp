// fanbeam cost, picture level beside signal level: which effects either is measured with.
#include "apps/cost_levels.h"

#include <catch2/catch.hpp>

#include "scenes/scene_reader.h"

using namespace fanbeam;

TEST_CASE("The picture level is measured with every effect of the plan, the signal level without",
          "[cost]") {
  core::ProblemList problems;
  scenes::SceneDescription description = scenes::read_scene(
      FANBEAM_SOURCE_DIR "/scenes/braunschweig-26", {FANBEAM_SOURCE_DIR, {}, ""}, problems);
  // The middle of the picture, which holds the truck: bounces change it by 1.8 grey RMS.
  description.sensor.scan.field_of_view_rad *= 2.0 / description.sensor.scan.columns;
  description.sensor.scan.columns = 2;
  const auto scene = scenes::build_scene(description, {}, problems);
  REQUIRE(scene->plan.runs(core::EffectId::double_bounce));
  const auto with_sensor = [&](const sensors::Sensor& sensor) {
    description.sensor = sensor;
    return std::shared_ptr<const scenes::Scene>(scenes::build_scene(description, {}, problems));
  };
  measure::Effort effort;
  effort.repetitions = 1;
  effort.reference_passes = 2;
  effort.rays = {4};
  effort.looks = {1};
  const measure::CostBench bench{.scene = *scene,
                                 .rebuild = {},
                                 .with_sensor = with_sensor,
                                 .build = {},
                                 .effort = effort,
                                 .pace = {},
                                 .slices = false,
                                 .sampling = {},
                                 .frames = {974}};
  const std::vector<measure::LevelStep> whole = apps::measure_levels(bench);
  for (core::EffectDecision& decision : scene->plan.decisions)
    if (decision.effect == core::EffectId::double_bounce) decision.on = false;
  const std::vector<measure::LevelStep> without = apps::measure_levels(bench);
  REQUIRE(whole.size() == 2);
  REQUIRE(without.size() == 2);
  CHECK(whole[0].level == "picture");
  CHECK(whole[0].rms_grey != without[0].rms_grey);
  CHECK(whole[1].level == "signal");
  CHECK(whole[1].rms_grey == without[1].rms_grey);
}
