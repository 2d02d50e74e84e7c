// Plans of single frames: what a frame goes without it cannot see, and nobody sees it go.
#include "scenes/frame_plan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/effect_plan.h"
#include "renderer/plan/plan.h"
#include "renderer/planned_frames.h"
#include "sensors/sensor_file.h"
#include "tests/scenes/far_approach.h"
#include "tests/scenes/grey_difference.h"

namespace fanbeam::tests {
namespace {

constexpr core::EffectId kStages[] = {core::EffectId::rain_echo, core::EffectId::double_bounce,
                                      core::EffectId::multipath};

bool same_stages(const core::EffectPlan& a, const core::EffectPlan& b) {
  for (std::size_t i = 0; i < a.decisions.size(); ++i)
    if (a.decisions[i].on != b.decisions[i].on) return false;
  return true;
}

renderer::Sampling few_rays() {
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  return sampling;
}

// Of the frame by its own plan against the sequence's.
double change_of(const scenes::Scene& scene, int frame) {
  renderer::PlannedFrames renderers(scene.world, few_rays(), 1);
  const renderer::FramePose pose = scene.frame_pose(frame);
  return largest_difference_grey(
      renderers.render(scene.plan, {true, true}, pose),
      renderers.render(scenes::frame_plan(scene, frame), {true, true}, pose));
}

const core::EffectDecision& decision(const core::EffectPlan& plan, core::EffectId effect) {
  for (const core::EffectDecision& found : plan.decisions)
    if (found.effect == effect) return found;
  FAIL("no effect " << effect);
  return plan.decisions.front();
}

}  // namespace

TEST_CASE("A frame goes without what lies out of its range, and runs what lies within",
          "[scenes][frame_plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  const auto scene = built_for_frames(folder);
  const double range_m = scene->description.sensor.range.maximum_m();
  const auto place_m = [&](double north_of_threshold_m) {
    return glm::dvec3(0.0, north_of_threshold_m, 0.0);
  };
  for (const core::EffectId stage : kStages) REQUIRE(scene->plan.runs(stage));
  int checked = 0;
  for (int frame = 0; frame < scene->frame_count(); frame += 40) {
    INFO("frame " << frame);
    const core::EffectPlan plan = scenes::frame_plan(*scene, frame);
    const glm::dvec3 at_m = scene->frame_pose(frame).position_m;
    const auto check = [&](core::EffectId stage, double place, double size_m, double coarse_m) {
      const double distance_m = glm::distance(at_m, place_m(place));
      INFO(stage << " at " << distance_m << " m");
      if (distance_m > range_m + size_m + coarse_m) CHECK_FALSE(plan.runs(stage));
      // Nearer by, the post leaves the beam below.
      if (distance_m < range_m - 100.0 && distance_m > 1000.0) CHECK(plan.runs(stage));
      checked += distance_m > range_m + size_m + coarse_m ? 1 : 1000;
    };
    check(core::EffectId::double_bounce, 300.0, 70.0, 250.0);
    check(core::EffectId::multipath, -600.0, 0.0, 50.0);
    check(core::EffectId::rain_echo, 1500.0, 400.0, 50.0);
    if (!plan.runs(core::EffectId::multipath))
      CHECK(decision(plan, core::EffectId::multipath).reason ==
            "no point target is in view, or no ground mirrors within range");
  }
  // Both answers came up.
  CHECK(checked % 1000 > 10);
  CHECK(checked / 1000 > 10);
}

TEST_CASE("A frame's plan is that of its facts, within the sequence's", "[scenes][frame_plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  const auto scene = built_for_frames(folder);
  for (int frame = 0; frame < scene->frame_count(); frame += 100) {
    INFO("frame " << frame);
    const renderer::SceneFacts facts = scenes::frame_facts(*scene, frame);
    CHECK(facts.lowest_m >= scene->facts.lowest_m - 1.0);
    CHECK(facts.highest_m <= scene->facts.highest_m + 1.0);
    const core::EffectPlan plan = scenes::frame_plan(*scene, frame);
    const core::EffectPlan alone = renderer::plan(facts, 0.5, {});
    for (const core::EffectDecision& each : plan.decisions) {
      INFO(each.effect);
      if (std::find(std::begin(kStages), std::end(kStages), each.effect) == std::end(kStages))
        CHECK(each.on == scene->plan.runs(each.effect));
      else
        CHECK(each.on == alone.runs(each.effect));
      CHECK(decision(alone, each.effect).bound_grey <=
            decision(scene->plan, each.effect).bound_grey + 1e-9);
    }
  }
}

TEST_CASE("No switch from frame to frame is seen", "[scenes][frame_plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  for (const double accuracy_grey : {0.5, 8.0}) {
    const auto scene = built_for_frames(folder, accuracy_grey);
    int switches = 0;
    core::EffectPlan before = scenes::frame_plan(*scene, 0);
    for (int frame = 1; frame < scene->frame_count(); ++frame) {
      core::EffectPlan plan = scenes::frame_plan(*scene, frame);
      if (!same_stages(plan, before)) {
        ++switches;
        for (const int side : {frame - 1, frame}) {
          INFO("frame " << side << " at " << accuracy_grey << " grey levels");
          CHECK(change_of(*scene, side) <= accuracy_grey / 2.0);
        }
      }
      before = std::move(plan);
    }
    CHECK(switches >= 3);
    // Once all is in view the stages do matter.
    constexpr int kAllInView = 950;
    REQUIRE(same_stages(scenes::frame_plan(*scene, kAllInView), scene->plan));
    renderer::PlannedFrames renderers(scene->world, few_rays(), 1);
    for (const core::EffectId stage : kStages) {
      INFO(stage);
      core::EffectPlan without = scene->plan;
      for (core::EffectDecision& each : without.decisions)
        if (each.effect == stage) each.on = false;
      const renderer::FramePose pose = scene->frame_pose(kAllInView);
      CHECK(largest_difference_grey(renderers.render(scene->plan, {true, true}, pose),
                                    renderers.render(without, {true, true}, pose)) > 0.0);
    }
  }
}

TEST_CASE("Whatever a frame goes without is not there: bodies anywhere, rolling or sloping ground",
          "[scenes][frame_plan]") {
  struct Difference {
    const char* from;
    const char* to;
  };
  int left_out = 0;
  for (const Difference& difference :
       {Difference{"behind_threshold_m = 300.0, left_m = 60.0",
                   "behind_threshold_m = -2500.0, left_m = 900.0"},
        {"behind_threshold_m = 300.0, left_m = 60.0",
         "behind_threshold_m = -4000.0, left_m = -400.0"},
        {"material = \"short_grass\"",
         "generator = \"rolling\"\nrelief_m = 30.0\nfields = [\"bare_soil\", \"short_grass\"]"},
        {"material = \"short_grass\"", "material = \"crops\""},
        {"elevation_m = 50.0 }\nedge", "elevation_m = 58.0 }\nedge"}}) {
    INFO(difference.to);
    const TemporaryFolder folder;
    write_far_approach(folder, difference.from, difference.to);
    const auto scene = built_for_frames(folder);
    for (int frame = 0; frame < scene->frame_count(); frame += 60) {
      INFO("frame " << frame);
      const core::EffectPlan plan = scenes::frame_plan(*scene, frame);
      if (same_stages(plan, scene->plan)) continue;
      ++left_out;
      CHECK(change_of(*scene, frame) == 0.0);
    }
  }
  CHECK(left_out > 10);
}

// It ran for 19 ms a frame and changed nothing.
TEST_CASE("A building behind the antenna, or beside its fan, is no corner of level ground's",
          "[scenes][frame_plan]") {
  const TemporaryFolder folder;
  write_far_approach(folder, "behind_threshold_m = 300.0, left_m = 60.0",
                     "behind_threshold_m = -2500.0, left_m = 400.0");
  const auto scene = built_for_frames(folder);
  const glm::dvec3 building_m(-400.0, -2500.0, 0.0);
  int behind = 0, ahead = 0;
  for (int frame = 0; frame < scene->frame_count(); frame += 20) {
    const sensors::AntennaFrame antenna =
        renderer::antenna_of(scene->description.sensor, scene->frame_pose(frame));
    const glm::dvec3 to_m = building_m - antenna.position_m;
    const double along_m = glm::dot(to_m, antenna.forward);
    INFO("frame " << frame << ", building " << along_m << " m ahead");
    const core::EffectPlan plan = scenes::frame_plan(*scene, frame);
    if (along_m < 1000.0) CHECK_FALSE(plan.runs(core::EffectId::double_bounce));
    if (along_m > 2700.0 && glm::length(to_m) < 3400.0)
      CHECK(plan.runs(core::EffectId::double_bounce));
    behind += along_m < 1000.0 ? 1 : 0;
    ahead += along_m > 2700.0 && glm::length(to_m) < 3400.0 ? 1 : 0;
  }
  CHECK(behind > 5);
  CHECK(ahead > 5);
}

TEST_CASE("What the sequence leaves out takes its share of a frame's budget first",
          "[scenes][frame_plan]") {
  renderer::SceneFacts facts;
  core::ProblemList problems;
  facts.sensor =
      sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
  facts.weather.rain_rate_mm_per_h = 0.01;
  core::EffectPlan sequence;
  sequence.decisions = {{core::EffectId::gas, false, "", 0.0, 0.0},
                        {core::EffectId::rain_echo, true, "", 50.0, 12.0}};
  const auto with_gas = [&](double gas_grey) {
    sequence.decisions[0].bound_grey = gas_grey;
    return renderer::frame_plan(sequence, facts, 0.5, {}).decisions[1];
  };
  facts.largest_eta_m2_per_m3 = 1e-15;
  facts.largest_eta_m2_per_m3 *= 0.1 / with_gas(0.0).bound_grey;
  REQUIRE(with_gas(0.0).bound_grey == Approx(0.1).epsilon(0.05));
  CHECK_FALSE(with_gas(0.1).on);
  CHECK(with_gas(0.2).on);
  CHECK(with_gas(0.2).reason.find("more than the 0.05 that the budget leaves") !=
        std::string::npos);
  // Forced on is forced on, in every frame.
  facts.largest_eta_m2_per_m3 = 0.0;
  CHECK_FALSE(with_gas(0.0).on);
  CHECK(renderer::frame_plan(sequence, facts, 0.5, renderer::parse_effect_wishes("+rain-echo"))
            .runs(core::EffectId::rain_echo));
}

}  // namespace fanbeam::tests
