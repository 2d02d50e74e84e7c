// Of a setting, what can be had in milliseconds: plan, tables, world.
#include <chrono>

#include "core/number_range.h"
#include "renderer/plan/plan.h"
#include "renderer/stages/side_lobes.h"
#include "scenes/frame_sight.h"
#include "scenes/plan_facts.h"
#include "scenes/scene.h"
#include "scenes/scene_caster.h"
#include "scenes/scene_mirrors.h"
#include "scenes/scene_pose.h"
#include "scenes/weather_placement.h"

namespace fanbeam::scenes {
namespace {

atmosphere::Weather simulated_weather(atmosphere::Weather weather, const core::EffectPlan& plan) {
  weather.simulate_gas = plan.runs(core::EffectId::gas);
  weather.simulate_fog = plan.runs(core::EffectId::fog);
  weather.simulate_rain = plan.runs(core::EffectId::rain);
  weather.simulate_snow = plan.runs(core::EffectId::snow);
  return weather;
}

std::vector<SurfaceRecord> records_of(const SceneSetting& scene, materials::SurfaceState state) {
  const Site::Parts& parts = scene.site->parts();
  return record_surfaces(scene.description, parts.library, parts.used, state);
}

void record_model_materials(const SceneSetting& scene, std::vector<SurfaceRecord>& surfaces) {
  const sensors::Waveform& waveform = scene.description.sensor.waveform;
  for (const auto& [name, surface] : scene.site->parts().model_materials)
    surfaces.push_back(
        {name, name, std::string(name_of(surface.reflectivity)), "stated by the model's files",
         validity_of(surface.reflectivity).grazing_rad,
         extrapolations_of(surface.reflectivity, waveform.polarisation, waveform.frequency_Hz)});
}

atmosphere::VolumeEcho volume_echo_of(const SceneSetting& scene) {
  return {scene.weather, scene.description.sensor.waveform.frequency_Hz};
}

double accuracy_of(const SceneSetting& scene) {
  if (scene.options.accuracy_grey > 0.0) return scene.options.accuracy_grey;
  return scene.description.accuracy_grey > 0.0 ? scene.description.accuracy_grey
                                               : kDefaultAccuracy_grey;
}

// What a plan is made of, and the plan.
struct Planned {
  SightMap sight;
  renderer::SceneFacts all_facts{}, facts{};
  double accuracy_grey = kDefaultAccuracy_grey, plan_s = 0.0;
  core::EffectPlan plan{};
};

Planned make_plan(const SceneSetting& scene, const std::vector<renderer::PointTarget>& targets) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const SceneDescription& description = scene.description;
  const std::vector<bool> mirroring =
      mirroring_materials(specular_surfaces(description, *scene.site, materials::SurfaceState::dry),
                          specular_surfaces(description, *scene.site, description.surface_state));
  Planned planned{scene.site->parts().sight.with_mirrors(mirroring)};
  planned.all_facts = facts_of(description, *scene.site, scene.volume, scene.weather,
                               volume_echo_of(scene).largest_eta_m2_per_m3(), targets, mirroring);
  planned.all_facts.heights_shown = scene.options.heights_shown;
  planned.all_facts.read = scene.options.read;
  planned.facts =
      planned_by_flight(scene)
          ? sequence_facts(planned.all_facts, planned.sight, targets, scene.frame_count(),
                           [&](int frame) { return scene.frame_pose(frame); })
          : planned.all_facts;
  planned.accuracy_grey = accuracy_of(scene);
  planned.plan =
      renderer::plan(planned.all_facts, planned.facts, planned.accuracy_grey, scene.options.wishes);
  planned.plan_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return planned;
}

renderer::World make_world(const SceneSetting& scene, const core::EffectPlan& plan,
                           std::vector<renderer::PointTarget> targets) {
  const SceneDescription& description = scene.description;
  const double frequency_Hz = description.sensor.waveform.frequency_Hz;
  const materials::SurfaceState state = plan.runs(core::EffectId::surface_state)
                                            ? description.surface_state
                                            : materials::SurfaceState::dry;
  const atmosphere::Weather weather = simulated_weather(scene.weather, plan);
  renderer::World world{.geometry = scene.site->parts().geometry,
                        .nrcs = scene.site->reflectivity(state),
                        .targets = std::move(targets),
                        .attenuation = atmosphere::PathAttenuation(weather, frequency_Hz),
                        .sensor = plan.runs(core::EffectId::side_lobes)
                                      ? description.sensor
                                      : renderer::without_side_lobes(description.sensor),
                        .specular = specular_surfaces(description, *scene.site, state)};
  const atmosphere::RainCells cells(weather, frequency_Hz);
  if (!cells.empty()) world.rain_cells = cells;
  if (plan.runs(core::EffectId::rain_echo)) world.volume_echo = volume_echo_of(scene);
  return world;
}

void check(const Scene& scene, const Conditions& conditions, core::ProblemList& problems) {
  const sensors::Waveform& waveform = scene.site->parts().waveform;
  if (conditions.sensor && (conditions.sensor->waveform.frequency_Hz != waveform.frequency_Hz ||
                            conditions.sensor->waveform.polarisation != waveform.polarisation))
    problems.error(core::ErrorClass::unsupported, {}, "sensor", "another carrier or polarisation",
                   "those that the scene was opened with: open it with that sensor");
  if (conditions.weather) {
    problems.append(atmosphere::problems_in(*conditions.weather, waveform.frequency_Hz).all());
    check_losses(*conditions.weather, problems);
  }
  if (conditions.accuracy_grey)
    core::check_range(problems, "accuracy_grey", *conditions.accuracy_grey,
                      renderer::kAccuracies_grey, "grey levels");
}

// The site with the models' own materials at the temperature of now; the same one where they do not
// change with it.
std::shared_ptr<const Site> site_at_temperature_of(const SceneDescription& scene,
                                                   const std::shared_ptr<const Site>& site,
                                                   core::ProblemList& problems) {
  auto materials = at_temperature_of(scene, site->parts().model_materials, problems);
  if (!materials) return site;
  Site::Parts parts = site->parts();
  parts.model_materials = std::move(*materials);
  return std::make_shared<const Site>(std::move(parts));
}

}  // namespace

int SceneSetting::frame_count() const {
  return trajectory ? trajectory->frame_count(description.sensor.scan.frame_rate_Hz) : 0;
}

bool planned_by_flight(const SceneSetting& scene) {
  return scene.trajectory && !scene.description.flight_heights.stated;
}

renderer::FramePose SceneSetting::pose_at(const core::Pose& pose) const {
  return pose_in(frame, pose);
}

renderer::FramePose SceneSetting::frame_pose(int frame_index) const {
  if (!trajectory)
    core::throw_input_error(core::ErrorClass::ref, "frame", frame_index,
                            "a pose: the scene has no [trajectory], and so no frames of its own");
  return scenes::frame_pose(frame, *trajectory, description.sensor, frame_index);
}

renderer::World world_for(const Scene& scene, const core::EffectPlan& plan) {
  return make_world(scene, plan, scene.world.targets);
}

std::unique_ptr<Scene> settled(SceneSetting setting, std::vector<renderer::PointTarget> targets,
                               core::ProblemList& problems) {
  Planned planned = make_plan(setting, targets);
  setting.caster = scene_caster(setting.description, setting.options.caster, setting.volume,
                                setting.site->parts().geometry->solids, planned.plan);
  const bool wet = planned.plan.runs(core::EffectId::surface_state);
  std::vector<SurfaceRecord> surfaces =
      records_of(setting, wet ? setting.description.surface_state : materials::SurfaceState::dry);
  if (planned.facts.mirrored_rays_end || planned.facts.has_point_targets)
    report_mirrors(setting.description, setting.site->parts().library, surfaces, problems);
  record_model_materials(setting, surfaces);
  renderer::World world = make_world(setting, planned.plan, std::move(targets));
  return std::make_unique<Scene>(Scene{std::move(setting), std::move(surfaces),
                                       std::move(planned.sight), planned.all_facts, planned.facts,
                                       planned.accuracy_grey, planned.plan_s,
                                       std::move(planned.plan), std::move(world)});
}

std::unique_ptr<Scene> under_conditions(const Scene& scene, const Conditions& conditions,
                                        core::ProblemList& problems) {
  check(scene, conditions, problems);
  problems.throw_if_errors();
  SceneSetting changed = scene;
  SceneDescription& description = changed.description;
  if (conditions.sensor) description.sensor = *conditions.sensor;
  if (conditions.weather) {
    changed.weather = *conditions.weather;
    description.weather = *conditions.weather;
    description.rain_cells.clear();  // places that nobody has put anything at any more
    changed.site = site_at_temperature_of(description, scene.site, problems);
  }
  if (conditions.accuracy_grey) changed.options.accuracy_grey = *conditions.accuracy_grey;
  if (conditions.wishes) changed.options.wishes = *conditions.wishes;
  if (conditions.surface_state) description.surface_state = *conditions.surface_state;
  const Site::Parts& parts = changed.site->parts();
  changed.volume = flight_volume(description, scene.frame, scene.trajectory,
                                 *parts.geometry->surfaces->terrain(), parts.facts);
  if (conditions.surface_state) check_surfaces(description, parts.library, parts.used, problems);
  check_caster(description, changed.options.caster, changed.volume, parts.geometry->solids,
               problems);
  problems.throw_if_errors();
  auto conditioned =
      settled(std::move(changed), conditions.targets.value_or(scene.world.targets), problems);
  conditioned->build_s = scene.build_s;
  return conditioned;
}

}  // namespace fanbeam::scenes
