// A sequence goes without what none of its frames sees, and says so.
#include <catch2/catch.hpp>

#include "core/effect_plan.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/planned_frames.h"
#include "scenes/frame_sight.h"
#include "sensors/sensor_file.h"
#include "tests/scenes/effect_scene.h"
#include "tests/scenes/far_approach.h"
#include "tests/scenes/grey_difference.h"

namespace fanbeam::tests {
namespace {

struct Change {
  const char* from;
  const char* to;
};

std::unique_ptr<scenes::Scene> approach(const std::vector<Change>& changes,
                                        const std::string& effects = "") {
  const TemporaryFolder folder;
  write_far_approach(folder);
  std::string scene = core::read_file((folder.path() / "scene.toml").string(), 1U << 20U);
  for (const Change& change : changes) scene = replaced(scene, change.from, change.to);
  folder.write("scene.toml", scene);
  return built_for_frames(folder, 0.5, effects);
}

const core::EffectDecision& decision_of(const scenes::Scene& scene, core::EffectId effect) {
  return decision_on(scene.plan, effect);
}

// Of every 60th frame: `one` as planned, `other` with what its plan was told to run, unseen or not.
double change_by_forced_grey(const scenes::Scene& one, const scenes::Scene& other,
                             const std::vector<core::EffectId>& forced) {
  for (const core::EffectId effect : forced) {
    INFO(effect);
    REQUIRE_FALSE(one.plan.runs(effect));
    REQUIRE(other.plan.runs(effect));
  }
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  renderer::PlannedFrames frames(one.world, sampling, 1);
  renderer::PlannedFrames others(other.world, sampling, 1);
  double largest = 0.0;
  for (int frame = 0; frame < one.frame_count(); frame += 60)
    largest = std::max(
        largest,
        largest_difference_grey(frames.render(one.plan, {true, true}, one.frame_pose(frame)),
                                others.render(other.plan, {true, true}, other.frame_pose(frame))));
  return largest;
}

constexpr Change kNoHangar = {
    "[[box]]\nname = \"hangar\"\nat = { runway = \"36\", "
    "behind_threshold_m = 300.0, left_m = 60.0 }\nlength_m = 40.0\n"
    "width_m = 30.0\nheight_m = 12.0\nwall = \"metal\"\n",
    ""};
constexpr Change kNoPost = {
    "[[target]]\nname = \"post\"\nat = { runway = \"36\", "
    "behind_threshold_m = -600.0, left_m = 20.0 }\nrcs = { shape = "
    "\"constant\", rcs_dBsm = 10.0 }\nabove_ground_m = 4.0\n",
    ""};
constexpr Change kHangarBehind = {"behind_threshold_m = 300.0, left_m = 60.0",
                                  "behind_threshold_m = -8500.0, left_m = 60.0"};
constexpr Change kShowerBeside = {"at = { runway = \"36\", behind_threshold_m = 1500.0 }",
                                  "at = { runway = \"36\", behind_threshold_m = -3000.0, "
                                  "left_m = 2500.0 }"};

}  // namespace

// It ran for 19 ms a frame, in every frame.
TEST_CASE("A building behind the whole flight is no corner, and nothing is lost without",
          "[scenes][frame_plan]") {
  const auto scene = approach({kHangarBehind});
  CHECK_FALSE(scene->plan.runs(core::EffectId::double_bounce));
  CHECK(decision_of(*scene, core::EffectId::double_bounce).reason ==
        "within range nothing mirrors, or nothing stands in the way of mirrored rays");
  const auto forced = approach({kHangarBehind}, "+double-bounce");
  CHECK(decision_of(*forced, core::EffectId::double_bounce).reason ==
        "switched on by the user; within range nothing mirrors, or nothing stands in the way of "
        "mirrored rays");
  CHECK(change_by_forced_grey(*scene, *forced, {core::EffectId::double_bounce}) == 0.0);
  CHECK(approach({})->plan.runs(core::EffectId::double_bounce));
  // Without it the plain's own curvature is left, which no mirrored ray meets either.
  CHECK(decision_of(*approach({kNoHangar}), core::EffectId::double_bounce).reason ==
        "within range nothing mirrors, or nothing stands in the way of mirrored rays");
}

TEST_CASE("A target that no frame has in view calls for no multipath", "[scenes][frame_plan]") {
  const Change behind = {"behind_threshold_m = -600.0, left_m = 20.0",
                         "behind_threshold_m = -8500.0, left_m = 20.0"};
  const auto scene = approach({behind});
  CHECK_FALSE(scene->plan.runs(core::EffectId::multipath));
  CHECK(change_by_forced_grey(*scene, *approach({behind}, "+multipath"),
                              {core::EffectId::multipath}) == 0.0);
}

// It was told as 432 grey levels.
TEST_CASE("A shower beside the fan is not there for a scene without mirrored rays",
          "[scenes][frame_plan]") {
  const auto scene = approach({kNoHangar, kNoPost, kShowerBeside});
  CHECK_FALSE(scene->plan.runs(core::EffectId::rain));
  CHECK_FALSE(scene->plan.runs(core::EffectId::rain_echo));
  CHECK(decision_of(*scene, core::EffectId::rain).reason ==
        "the scene has it, but nothing of it is in view");
  CHECK(change_by_forced_grey(*scene,
                              *approach({kNoHangar, kNoPost, kShowerBeside}, "+rain,+rain-echo"),
                              {core::EffectId::rain, core::EffectId::rain_echo}) == 0.0);
  // "all" runs them as well, "none" does not.
  for (const auto effect : {core::EffectId::rain, core::EffectId::rain_echo}) {
    CHECK(approach({kNoHangar, kNoPost, kShowerBeside}, "all")->plan.runs(effect));
    CHECK_FALSE(approach({kNoHangar, kNoPost, kShowerBeside}, "none")->plan.runs(effect));
  }
  CHECK(approach({kNoHangar, kNoPost})->plan.runs(core::EffectId::rain));
  // Rays that a wall mirrors may pass it; nothing changes more than the display has.
  const auto mirrored = approach({kShowerBeside});
  CHECK(mirrored->plan.runs(core::EffectId::rain));
  for (const core::EffectDecision& decision : mirrored->plan.decisions)
    CHECK(decision.bound_grey <= 255.0);
}

// It ran as 255 grey levels for one lamp anywhere on level ground.
TEST_CASE("A target's mirror image does not bring in a shower beside the fan",
          "[scenes][frame_plan]") {
  const auto scene = approach({kNoHangar, kShowerBeside});
  REQUIRE(scene->plan.runs(core::EffectId::multipath));
  CHECK_FALSE(scene->plan.runs(core::EffectId::rain));
  CHECK_FALSE(scene->plan.runs(core::EffectId::rain_echo));
  CHECK(change_by_forced_grey(*scene, *approach({kNoHangar, kShowerBeside}, "+rain,+rain-echo"),
                              {core::EffectId::rain, core::EffectId::rain_echo}) == 0.0);
  CHECK(approach({kNoHangar})->plan.runs(core::EffectId::rain));
}

TEST_CASE("Of a scene with corners a shower counts from anywhere within range, and from no farther",
          "[scenes][frame_plan]") {
  const auto at = [](const char* metres) {
    return approach({kNoPost, {"at = { runway = \"36\", behind_threshold_m = 1500.0 }", metres}})
        ->plan.runs(core::EffectId::rain);
  };
  // The flight passes it abeam and sees 3.7 km; its radius is 400 m.
  CHECK(at("at = { runway = \"36\", behind_threshold_m = -3000.0, left_m = 3900.0 }"));
  CHECK_FALSE(at("at = { runway = \"36\", behind_threshold_m = -3000.0, left_m = 4300.0 }"));
}

// It doubled: the beam was followed into the ground.
TEST_CASE("Rain does not take the bound of gas under a ground that fills the beam",
          "[scenes][frame_plan]") {
  const Change none = {"rain_rate_mm_per_h = 20.0", "rain_rate_mm_per_h = 0.0"};
  const double dry_dB = decision_of(*approach({none}), core::EffectId::gas).bound_dB;
  REQUIRE(dry_dB > 0.0);
  CHECK(decision_of(*approach({}), core::EffectId::gas).bound_dB == Approx(dry_dB).epsilon(0.02));
  // Nor where it ends 500 m behind the first frame, or so far beside that no ray passes its rim, of
  // the 3.7 km that all have.
  const auto ends = [](const std::string& sides) {
    return approach({Change{"half_extent_m = 9000.0", sides.c_str()}});
  };
  for (const char* sides :
       {"half_extent_m = 7000.0", "half_extent_m = 9000.0\nwest_m = 1500.0\neast_m = 1500.0"})
    CHECK(decision_of(*ends(sides), core::EffectId::gas).bound_dB == Approx(dry_dB).epsilon(0.02));
  // Over the rim ahead it does go down.
  const auto short_one = ends("half_extent_m = 9000.0\nnorth_m = 2000.0");
  CHECK(decision_of(*short_one, core::EffectId::gas).bound_dB > 1.1 * dry_dB);
}

// The shower took nothing by the plan, and 100 m of it from the target.
TEST_CASE("Steeply below, a target past the fan is seen through a shower past the fan",
          "[scenes][frame_plan]") {
  core::ProblemList problems;
  renderer::SceneFacts facts;
  facts.sensor =
      sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
  facts.has_point_targets = true;
  const scenes::SightMap map(terrain::make_height_field(-1000.0, -1000.0, 1000.0, 1000.0, 50.0), {},
                             {});
  sensors::AntennaFrame antenna;
  antenna.position_m.z = 3000.0;
  const auto sight_of = [&](double boresight_deg, double azimuth_deg) {
    const double elevation_rad = core::radians(boresight_deg);
    facts.sensor.antenna.boresight_elevation_rad = elevation_rad;
    const glm::dvec3 along = 2000.0 * sensors::direction(antenna, core::radians(azimuth_deg),
                                                         elevation_rad, facts.sensor.scan.surface);
    atmosphere::RainCell shower;
    shower.centre_m = glm::dvec2(along) / 2.0;
    shower.radius_m = 3.0;
    shower.rain_rate_mm_per_h = 10.0;
    facts.weather.rain_cells = {shower};
    const std::vector<renderer::PointTarget> targets = {{"sphere",
                                                         materials::ConstantRcs{1.0},
                                                         {{0.0, antenna.position_m + along}},
                                                         glm::dmat3(1.0)}};
    return scenes::frame_sight(facts, map, targets, antenna, 0.0);
  };
  // The fan ends at 23 deg, and the beam of the last column at 20.4 + 1.25 / cos 75 deg = 25.2 deg.
  const renderer::FrameSight steep = sight_of(-75.0, 24.5);
  CHECK(steep.point_targets);
  CHECK(steep.rain_cells.size() == 1);
  // Ahead nobody sees what stands there.
  const renderer::FrameSight ahead = sight_of(-3.8, 24.5);
  CHECK_FALSE(ahead.point_targets);
  CHECK(ahead.rain_cells.empty());
}

TEST_CASE(
    "Lobes in azimuth see a mirrored target sixteen times as bright at most, lobes in elevation "
    "change how its paths cancel",
    "[effects]") {
  core::ProblemList problems;
  renderer::SceneFacts facts;
  facts.sensor =
      sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
  facts.has_point_targets = facts.ground_reflects = true;
  facts.rcs_sum_m2 = 10.0;
  const auto bound_dB = [&] {
    return decision_on(renderer::plan(facts, 0.5, {}), core::EffectId::side_lobes).bound_dB;
  };
  sensors::Antenna& antenna = facts.sensor.antenna;
  antenna.azimuth.side_lobe_gain = 1e-5;
  antenna.azimuth.side_lobe_extent_rad = 1.0;
  const double mirrored_dB = bound_dB();
  CHECK(mirrored_dB > 0.0);
  CHECK(mirrored_dB < 50.0);
  facts.ground_reflects = false;
  CHECK(bound_dB() < mirrored_dB);
  facts.ground_reflects = true;
  antenna.elevation.side_lobe_gain = 1e-5;
  antenna.elevation.side_lobe_extent_rad = 1.0;
  CHECK(bound_dB() == Approx(60.0));
  // The same largest echo in a row as in a cell: sixteen times, where both paths are shortest.
  const auto echo = [&](const renderer::EchoSources& sources) {
    return renderer::largest_echo(sources, renderer::whole_beam(facts.sensor), facts.sensor);
  };
  const renderer::AddedPower direct = echo({.rcs_m2 = 1.0});
  const renderer::AddedPower mirrored = echo({.mirrored_rcs_m2 = 1.0});
  CHECK(mirrored.cell_W[0] == Approx(16.0 * direct.cell_W[0]));
  CHECK(mirrored.row_W_m3 >= 16.0 * direct.row_W_m3 * (1.0 - 1e-12));
  for (std::size_t i = 1; i < direct.cell_W.size(); i += 20)
    CHECK(mirrored.cell_W[i] > 16.0 * direct.cell_W[i]);
}

}  // namespace fanbeam::tests
