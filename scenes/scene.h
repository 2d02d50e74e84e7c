// A scene ready to render.
#pragma once

#include <memory>

#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/plan.h"
#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/scene_surfaces.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

struct Scene {
  SceneDescription description;
  terrain::LocalFrame frame;
  Trajectory trajectory;
  core::EffectPlan plan;
  renderer::World world;
  double build_s = 0.0;
  std::vector<SurfaceRecord> surfaces{};  // materials in use, as shown

  int frame_count() const { return trajectory.frame_count(description.sensor.scan.frame_rate_Hz); }
  renderer::FramePose frame_pose(int frame_index) const;
  renderer::FramePose pose_at(const core::Pose& pose) const;
};

struct BuildOptions {
  renderer::EffectWishes wishes;
  double accuracy_grey = 0.5;
  std::string instruction_set;  // see RayScene
};

// Loads what the description names and puts the world together. Everything wrong is collected in
// `problems` and then thrown as one InputError; warnings stay in `problems`. Errors beside those of
// the files: E-REF for unknown materials and runway names, E-RANGE for a runway, object or
// trajectory outside the terrain and a sensor inside the ground.
std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems);

}  // namespace fanbeam::scenes
