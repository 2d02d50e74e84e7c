// A scene ready to render.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"
#include "renderer/plan/scene_facts.h"
#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/scene_surfaces.h"
#include "scenes/sight_map.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// A runway's thresholds on the ground, local metres.
struct RunwayPlace {
  struct End {
    std::string name;  // of a landing on this threshold
    glm::dvec3 threshold_m{0.0};
  };
  End ends[2];
};

// Grey levels that a picture may be off; half of it is for effects left out.
inline constexpr double kDefaultAccuracy_grey = 0.5;

struct Scene {
  SceneDescription description;
  terrain::LocalFrame frame;
  Trajectory trajectory;
  core::EffectPlan plan;
  renderer::World world;
  double build_s = 0.0;
  renderer::CasterChoice caster{};
  std::vector<SurfaceRecord> surfaces{};  // materials in use, as shown
  // Building parts that do not reach the ground; those over open air are triangles and boxes, but
  // no solids of `world`.
  std::size_t raised_buildings = 0, floating_buildings = 0;
  // What the plan was made of, the scene as its frames see it, and how long that took.
  renderer::SceneFacts facts{};
  renderer::EffectWishes wishes{};
  double accuracy_grey = kDefaultAccuracy_grey;
  double plan_s = 0.0;
  std::optional<SightMap> sight{};
  std::vector<RunwayPlace> runways{};

  int frame_count() const { return trajectory.frame_count(description.sensor.scan.frame_rate_Hz); }
  renderer::FramePose frame_pose(int frame_index) const;
  renderer::FramePose pose_at(const core::Pose& pose) const;
};

struct BuildOptions {
  renderer::EffectWishes wishes;
  std::optional<renderer::CasterWish> caster;  // instead of the scene's
  double accuracy_grey = 0.0;                  // 0: the scene's, else the default
  std::string instruction_set;                 // see RayScene
  bool robust = true;                          // see RayScene
};

// Loads what the description names and puts the world together. Everything wrong is collected in
// `problems` and then thrown as one InputError; warnings stay in `problems`. Errors beside those of
// the files: E-REF for unknown materials and runway names, E-RANGE for a runway, object or
// trajectory outside the terrain and a sensor inside the ground; E-UNSUPPORTED for slices that are
// forced on a scene they cannot show.
std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems);

}  // namespace fanbeam::scenes
