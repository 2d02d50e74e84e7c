#include "scenes/frame_plan.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/effect_catalogue.h"
#include "renderer/plan/frame_facts.h"
#include "scenes/frame_sight.h"

namespace fanbeam::scenes {
namespace {

// `facts` narrowed to what is seen from a pose.
renderer::SceneFacts seen_from(const Scene& scene, const renderer::SceneFacts& facts,
                               const renderer::FramePose& pose) {
  return renderer::seen_facts(
      facts, frame_sight(facts, scene.sight, scene.world.targets,
                         renderer::antenna_of(scene.description.sensor, pose), pose.time_s));
}

// From the origin's vertical to the aircraft's.
double vertical_turn_rad(const renderer::FramePose& pose) {
  const glm::dvec3& down = pose.north_east_down[2];
  return std::atan2(std::hypot(down.x, down.y), -down.z);
}

}  // namespace

renderer::SceneFacts frame_facts(const Scene& scene, int frame_index) {
  return seen_from(scene, scene.facts, scene.frame_pose(frame_index));
}

core::EffectPlan frame_plan(const Scene& scene, int frame_index) {
  return renderer::frame_plan(scene.plan, frame_facts(scene, frame_index), scene.accuracy_grey,
                              scene.options.wishes);
}

bool planned_for(const Scene& scene, const renderer::FramePose& pose) {
  if (!planned_by_flight(scene)) return scene.volume.holds(pose.position_m);
  // Between two poses of a flight the vertical is theirs but for rounding.
  constexpr double kRounding_m = 1.0;
  renderer::SceneFacts turned = scene.facts;
  turned.vertical_turn_rad = vertical_turn_rad(pose);
  const bool within_margin =
      renderer::height_margin_m(turned) <= renderer::height_margin_m(scene.facts) + kRounding_m;
  return within_margin && scene.volume.holds_height(pose.position_m.z) &&
         renderer::covers(scene.facts, seen_from(scene, scene.all_facts, pose));
}

core::EffectPlan plan_alone(const Scene& scene, const renderer::FramePose& pose) {
  renderer::SceneFacts facts = scene.all_facts;
  const double height_m = renderer::antenna_of(scene.description.sensor, pose).position_m.z;
  facts.lowest_m = std::min({facts.lowest_m, height_m, pose.position_m.z});
  facts.highest_m = std::max({facts.highest_m, height_m, pose.position_m.z});
  facts.vertical_turn_rad = std::max(facts.vertical_turn_rad, vertical_turn_rad(pose));
  return renderer::plan(facts, scene.accuracy_grey, scene.options.wishes);
}

}  // namespace fanbeam::scenes
