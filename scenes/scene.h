// A scene ready to render.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atmosphere/weather.h"
#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/frame_pose.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"
#include "renderer/plan/scene_facts.h"
#include "renderer/world.h"
#include "scenes/description.h"
#include "scenes/flight_volume.h"
#include "scenes/scene_surfaces.h"
#include "scenes/sight_map.h"
#include "scenes/site.h"
#include "scenes/trajectory/trajectory.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// A runway on the ground, local metres.
struct RunwayPlace {
  struct End {
    std::string name;  // of a landing on this threshold
    glm::dvec3 threshold_m{0.0};
    glm::dvec3 pavement_end_m{0.0};  // in front of a displaced threshold
  };
  End ends[2];
  double width_m = 0.0;
  double strip_half_width_m = 0.0;  // level ground on each side of the centre line
};

// Grey levels that a picture may be off; half of it is for effects left out.
inline constexpr double kDefaultAccuracy_grey = 0.5;

struct BuildOptions {
  renderer::EffectWishes wishes;
  std::optional<renderer::CasterWish> caster;  // instead of the scene's
  double accuracy_grey = 0.0;                  // 0: the scene's, else the default
  bool heights_shown = true;                   // false: neither C-scopes nor obstacles are wanted
  std::string instruction_set;                 // see RayScene
  bool robust = true;                          // see RayScene
  renderer::Readings read{};                   // what is wanted beside pictures
};

// A site and what is said of it now. Copies share the site.
struct SceneSetting {
  SceneDescription description;  // its sensor, weather and surface state are those of now
  BuildOptions options;
  terrain::LocalFrame frame;
  std::shared_ptr<const Site> site{};
  std::optional<Trajectory> trajectory{};
  FlightVolume volume{};
  atmosphere::Weather weather{};  // with its rain cells placed
  std::vector<RunwayPlace> runways{};
  // Building parts that do not reach the ground; those over open air are triangles and boxes, but
  // no solids of `world`.
  std::size_t raised_buildings = 0, floating_buildings = 0;
  renderer::CasterChoice caster{};

  // 0 without a trajectory.
  int frame_count() const;
  renderer::FramePose frame_pose(int frame_index) const;
  renderer::FramePose pose_at(const core::Pose& pose) const;
};

// The same with all that follows from it; under_conditions() makes others of it.
struct Scene : SceneSetting {
  std::vector<SurfaceRecord> surfaces{};  // materials in use, as shown
  SightMap sight;
  // Of the whole flight volume, and narrowed to what the frames of the trajectory see where there is
  // one and nothing else is stated: what the plan was made of.
  renderer::SceneFacts all_facts{}, facts{};
  double accuracy_grey = kDefaultAccuracy_grey;
  double plan_s = 0.0;
  core::EffectPlan plan{};
  renderer::World world;
  double build_s = 0.0;
};

// Loads what the description names and puts the world together. Everything wrong is collected in
// `problems` and then thrown as one InputError; warnings stay in `problems`. Errors beside those of
// the files: E-REF for unknown materials and runway names, told beside what the reader found, E-RANGE for a runway, object or
// trajectory outside the terrain and a sensor inside the ground; E-UNSUPPORTED for slices that are
// forced on a scene they cannot show.
std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems);

// What follows from a setting with `targets` in it; warnings of mirrors stay in `problems`.
std::unique_ptr<Scene> settled(SceneSetting setting, std::vector<renderer::PointTarget> targets,
                               core::ProblemList& problems);

// What of a scene may change in milliseconds; what is not set stays. The sensor keeps its carrier
// and polarisation: materials and wires were looked up for them.
struct Conditions {
  std::optional<sensors::Sensor> sensor{};
  std::optional<atmosphere::Weather> weather{};  // with its rain cells placed, local metres
  std::optional<materials::SurfaceState> surface_state{};
  std::optional<std::vector<renderer::PointTarget>> targets{};
  std::optional<double> accuracy_grey{};
  std::optional<renderer::EffectWishes> wishes{};
};

// The scene's plan was made of what the frames of its trajectory see, not of a stated volume.
bool planned_by_flight(const SceneSetting& scene);

// The same site under other conditions, planned anew; `scene` stays as it is. Throws InputError with
// every problem: those of atmosphere::problems_in, E-UNSUPPORTED for another carrier or polarisation,
// for a loss that the weather switches off (BuildOptions::wishes do that), for a model's own material
// that is not known at the new temperature and for slices that were forced and no longer can show the
// scene, E-RANGE for a material that is not known in its new state;
// warnings stay in `problems`. Cost: docs/performance-notes.md.
std::unique_ptr<Scene> under_conditions(const Scene& scene, const Conditions& conditions,
                                        core::ProblemList& problems);

// The world of a plan: what it leaves out is not in it.
renderer::World world_for(const Scene& scene, const core::EffectPlan& plan);

}  // namespace fanbeam::scenes
