#include "scenes/scene.h"

#include <chrono>
#include <cmath>

#include "materials/library/material_library.h"
#include "renderer/stages/side_lobes.h"
#include "scenes/flight_window.h"
#include "scenes/frame_sight.h"
#include "scenes/ground.h"
#include "scenes/model_materials.h"
#include "scenes/objects.h"
#include "scenes/plan_facts.h"
#include "scenes/scene_caster.h"
#include "scenes/scene_mirrors.h"
#include "scenes/scene_pose.h"
#include "scenes/scene_surfaces.h"
#include "scenes/trajectory/trajectory_builder.h"
#include "scenes/weather_placement.h"
#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

atmosphere::Weather simulated_weather(atmosphere::Weather weather, const core::EffectPlan& plan) {
  weather.simulate_gas = plan.runs(renderer::kGas);
  weather.simulate_fog = plan.runs(renderer::kFog);
  weather.simulate_rain = plan.runs(renderer::kRain);
  weather.simulate_snow = plan.runs(renderer::kSnow);
  return weather;
}

std::vector<SurfaceRecord> records_of(const Scene& scene, materials::SurfaceState state) {
  const Site::Parts& parts = scene.site->parts();
  return record_surfaces(scene.description, parts.library, parts.used, state);
}

void record_model_materials(Scene& scene) {
  const sensors::Waveform& waveform = scene.description.sensor.waveform;
  for (const ModelMaterials::Entry& entry : scene.site->parts().model_materials)
    scene.surfaces.push_back(
        {entry.name, entry.name, std::string(name_of(entry.surface)), "stated by the model's files",
         validity_of(entry.surface).grazing_rad,
         extrapolations_of(entry.surface, waveform.polarisation, waveform.frequency_Hz)});
}

atmosphere::VolumeEcho volume_echo_of(const Scene& scene) {
  return {scene.weather, scene.description.sensor.waveform.frequency_Hz};
}

double accuracy_of(const Scene& scene) {
  if (scene.options.accuracy_grey > 0.0) return scene.options.accuracy_grey;
  return scene.description.accuracy_grey > 0.0 ? scene.description.accuracy_grey
                                               : kDefaultAccuracy_grey;
}

void make_plan(const std::vector<renderer::PointTarget>& targets, Scene& scene) {
  const auto begin = Clock::now();
  const SceneDescription& description = scene.description;
  const std::vector<bool> mirroring =
      mirroring_materials(specular_surfaces(description, *scene.site, materials::SurfaceState::dry),
                          specular_surfaces(description, *scene.site, description.surface_state));
  scene.sight = scene.site->parts().sight.with_mirrors(mirroring);
  scene.all_facts = facts_of(description, *scene.site, scene.volume, scene.weather,
                             volume_echo_of(scene).largest_eta_m2_per_m3(), targets, mirroring);
  scene.all_facts.heights_shown = scene.options.heights_shown;
  scene.facts = planned_by_flight(scene)
                    ? sequence_facts(scene.all_facts, scene.sight, targets, scene.frame_count(),
                                     [&](int frame) { return scene.frame_pose(frame); })
                    : scene.all_facts;
  scene.accuracy_grey = accuracy_of(scene);
  scene.plan =
      renderer::plan(scene.all_facts, scene.facts, scene.accuracy_grey, scene.options.wishes);
  scene.plan_s = seconds_since(begin);
}

// All that follows from the site and what is set.
void settle(std::vector<renderer::PointTarget> targets, Scene& scene, core::ProblemList& problems) {
  make_plan(targets, scene);
  const bool wet = scene.plan.runs(renderer::kSurfaceState);
  scene.surfaces =
      records_of(scene, wet ? scene.description.surface_state : materials::SurfaceState::dry);
  if (scene.facts.has_walls || scene.facts.has_point_targets)
    report_mirrors(scene.description, scene.site->parts().library, scene.surfaces, problems);
  record_model_materials(scene);
  scene.world.targets = std::move(targets);
  scene.world = world_for(scene, scene.plan);
}

// By material id.
std::vector<std::string> names_of(const materials::MaterialLibrary& library,
                                  const ModelMaterials& model_materials) {
  std::vector<std::string> names;
  for (const materials::Material& material : library.all()) names.push_back(material.name);
  for (const ModelMaterials::Entry& entry : model_materials.all()) names.push_back(entry.name);
  return names;
}

std::vector<RunwayPlace> runway_places(const SceneDescription& scene, const Ground& ground) {
  std::vector<RunwayPlace> places;
  for (std::size_t i = 0; i < scene.runways.size(); ++i) {
    RunwayPlace place;
    for (const int end : {0, 1})
      place.ends[end] = {scene.runways[i].ends[end].name,
                         ground.on_ground_m(ground.runways()[i].threshold_m(end), 0.0)};
    places.push_back(std::move(place));
  }
  return places;
}

core::Geodetic ellipsoidal_origin(const SceneDescription& scene) {
  core::Geodetic origin = scene.origin;
  if (scene.datum == core::VerticalDatum::egm96)
    origin.height_m += terrain::egm96_geoid_height_m(origin.latitude_rad, origin.longitude_rad);
  return origin;
}

FlightVolume flight_volume(const SceneDescription& description, const terrain::LocalFrame& frame,
                           const std::optional<Trajectory>& trajectory,
                           const terrain::HeightField& ground, const SiteFacts& site) {
  const bool stated = description.flight_heights.stated || !trajectory;
  FlightVolume volume = stated ? volume_over(ground, site, frame, description) : FlightVolume{};
  if (!trajectory) return volume;
  const FlightVolume flown = volume_of(*trajectory, frame);
  return stated ? both(volume, flown) : flown;
}

void check(const Scene& scene, const Conditions& conditions, core::ProblemList& problems) {
  const sensors::Waveform& waveform = scene.site->parts().waveform;
  if (conditions.sensor && (conditions.sensor->waveform.frequency_Hz != waveform.frequency_Hz ||
                            conditions.sensor->waveform.polarisation != waveform.polarisation))
    problems.error(core::ErrorClass::unsupported, {}, "sensor", "another carrier or polarisation",
                   "those that the scene was opened with: open it with that sensor");
  if (conditions.weather)
    problems.append(atmosphere::problems_in(*conditions.weather, waveform.frequency_Hz).all());
  if (conditions.accuracy_grey &&
      !(*conditions.accuracy_grey >= 0.01 && *conditions.accuracy_grey <= 100.0))
    problems.error(core::ErrorClass::range, {}, "accuracy_grey",
                   core::number_text(*conditions.accuracy_grey), "0.01 to 100 grey levels");
}

}  // namespace

int Scene::frame_count() const {
  return trajectory ? trajectory->frame_count(description.sensor.scan.frame_rate_Hz) : 0;
}

bool planned_by_flight(const Scene& scene) {
  return scene.trajectory && !scene.description.flight_heights.stated;
}

renderer::FramePose Scene::pose_at(const core::Pose& pose) const { return pose_in(frame, pose); }

renderer::FramePose Scene::frame_pose(int frame_index) const {
  if (!trajectory)
    core::throw_input_error(core::ErrorClass::ref, "frame", frame_index,
                            "a pose: the scene has no [trajectory], and so no frames of its own");
  return scenes::frame_pose(frame, *trajectory, description.sensor, frame_index);
}

renderer::World world_for(const Scene& scene, const core::EffectPlan& plan) {
  const SceneDescription& description = scene.description;
  const double frequency_Hz = description.sensor.waveform.frequency_Hz;
  const materials::SurfaceState state =
      plan.runs(renderer::kSurfaceState) ? description.surface_state : materials::SurfaceState::dry;
  const atmosphere::Weather weather = simulated_weather(scene.weather, plan);
  renderer::World world{.geometry = scene.site->parts().geometry,
                        .nrcs = scene.site->reflectivity(state),
                        .targets = scene.world.targets,
                        .attenuation = atmosphere::PathAttenuation(weather, frequency_Hz),
                        .sensor = plan.runs(renderer::kSideLobes)
                                      ? description.sensor
                                      : renderer::without_side_lobes(description.sensor),
                        .specular = specular_surfaces(description, *scene.site, state)};
  const atmosphere::RainCells cells(weather, frequency_Hz);
  if (!cells.empty()) world.rain_cells = cells;
  if (plan.runs(renderer::kRainEcho)) world.volume_echo = volume_echo_of(scene);
  return world;
}

std::unique_ptr<Scene> under_conditions(const Scene& scene, const Conditions& conditions,
                                        core::ProblemList& problems) {
  check(scene, conditions, problems);
  problems.throw_if_errors();
  auto changed = std::make_unique<Scene>(scene);
  SceneDescription& description = changed->description;
  if (conditions.sensor) description.sensor = *conditions.sensor;
  if (conditions.weather) {
    changed->weather = *conditions.weather;
    description.weather = *conditions.weather;
    description.rain_cells.clear();  // places that nobody has put anything at any more
  }
  if (conditions.accuracy_grey) changed->options.accuracy_grey = *conditions.accuracy_grey;
  if (conditions.wishes) changed->options.wishes = *conditions.wishes;
  if (conditions.surface_state) description.surface_state = *conditions.surface_state;
  const Site::Parts& parts = scene.site->parts();
  changed->volume = flight_volume(description, scene.frame, scene.trajectory,
                                  *parts.geometry->surfaces->terrain(), parts.facts);
  if (conditions.surface_state) check_surfaces(description, parts.library, parts.used, problems);
  changed->caster = scene_caster(description, changed->options.caster, changed->volume,
                                 parts.geometry->solids, problems);
  problems.throw_if_errors();
  settle(conditions.targets.value_or(scene.world.targets), *changed, problems);
  return changed;
}

std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems) {
  const auto begin = Clock::now();
  problems.throw_if_errors();
  materials::MaterialLibrary library =
      materials::MaterialLibrary::from_file(description.material_library, problems);
  const MaterialNames names(library, problems);
  const terrain::LocalFrame frame(ellipsoidal_origin(description), description.earth);
  const Ground ground(description, frame, names, problems);
  Objects objects = {"terrain"};
  std::vector<terrain::SurfacePatch> patches = build_patches(description, ground, names, objects);
  ModelMaterials model_materials(description, library.size(), problems);
  Bodies bodies =
      build_bodies(description, ground, names, model_materials, std::move(objects), problems);
  std::vector<renderer::PointTarget> targets = build_targets(description, ground, problems).points;
  atmosphere::Weather weather = placed_weather(description, ground);
  std::optional<Trajectory> trajectory;
  if (!problems.has_errors()) trajectory = build_trajectory(description, ground, frame, problems);
  FlightVolume volume;
  renderer::CasterChoice caster;
  std::optional<SiteFacts> stands;
  if (!ground.field().height_m.empty()) {
    stands.emplace(ground.field(), patches, bodies.meshes);
    volume = flight_volume(description, frame, trajectory, ground.field(), *stands);
    if (volume.lowest_m > volume.highest_m)
      problems.error(core::ErrorClass::range, description.flight_heights.place, "flight_volume",
                     core::number_text(std::round(volume.lowest_m)) + " to " +
                         core::number_text(std::round(volume.highest_m)) + " m above the origin",
                     "highest_m above lowest_m; what is not stated is the lowest ground, and the "
                     "highest with the sensor's range above it");
    caster = scene_caster(description, options.caster, volume, bodies.solids, problems);
  }
  check_surfaces(description, library, names.used(), problems);
  if (trajectory) check_flight(description, frame, *trajectory, ground.field(), problems);
  problems.throw_if_errors();

  const SightMap sight(ground.field(), patches, bodies.meshes);
  std::vector<std::string> material_names = names_of(library, model_materials);
  Site::Parts parts{.library = std::move(library),
                    .used = names.used(),
                    .model_materials = model_materials.all(),
                    .sight = sight,
                    .facts = *stands,
                    .geometry = nullptr,
                    .waveform = description.sensor.waveform};
  parts.geometry = std::make_shared<renderer::Geometry>(renderer::Geometry{
      std::make_unique<terrain::RayScene>(ground.field(), std::move(patches),
                                          std::move(bodies.meshes), options.instruction_set,
                                          options.robust),
      std::move(bodies.solids), std::move(material_names), std::move(bodies.objects)});
  auto scene =
      std::make_unique<Scene>(Scene{.description = description,
                                    .options = options,
                                    .frame = frame,
                                    .site = std::make_shared<const Site>(std::move(parts)),
                                    .trajectory = std::move(trajectory),
                                    .volume = volume,
                                    .weather = std::move(weather),
                                    .runways = runway_places(description, ground),
                                    .raised_buildings = bodies.raised,
                                    .floating_buildings = bodies.floating,
                                    .caster = std::move(caster),
                                    .sight = sight,
                                    .world = {.geometry = nullptr,
                                              .attenuation = atmosphere::PathAttenuation(
                                                  {}, description.sensor.waveform.frequency_Hz),
                                              .sensor = description.sensor}});
  for (const std::filesystem::path& file : model_materials.files())
    scene->description.files.push_back(file);
  settle(std::move(targets), *scene, problems);
  scene->build_s = seconds_since(begin);
  return scene;
}

}  // namespace fanbeam::scenes
