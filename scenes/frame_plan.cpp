#include "scenes/frame_plan.h"

#include "renderer/plan/frame_facts.h"
#include "scenes/frame_sight.h"

namespace fanbeam::scenes {

renderer::SceneFacts frame_facts(const Scene& scene, int frame_index) {
  const renderer::FramePose pose = scene.frame_pose(frame_index);
  return renderer::seen_facts(
      scene.facts, frame_sight(scene.facts, *scene.sight, scene.world.targets,
                               renderer::antenna_of(scene.description.sensor, pose), pose.time_s));
}

core::EffectPlan frame_plan(const Scene& scene, int frame_index) {
  return renderer::frame_plan(scene.plan, frame_facts(scene, frame_index), scene.accuracy_grey,
                              scene.wishes);
}

}  // namespace fanbeam::scenes
