#include "scenes/scene.h"

#include <chrono>

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

void add_rain(const atmosphere::Weather& simulated, const core::EffectPlan& plan,
              const atmosphere::VolumeEcho& volume_echo, renderer::World& world) {
  const atmosphere::RainCells cells(simulated, world.sensor.waveform.frequency_Hz);
  if (!cells.empty()) world.rain_cells = cells;
  if (plan.runs(renderer::kRainEcho)) world.volume_echo = volume_echo;
}

// Behind the library's, where their ids count on.
void add_model_materials(const ModelMaterials& materials, const sensors::Waveform& waveform,
                         renderer::World& world) {
  for (const ModelMaterials::Entry& entry : materials.all()) {
    world.nrcs.emplace_back(entry.surface, waveform.polarisation, waveform.frequency_Hz);
    world.material_names.push_back(entry.name);
  }
}

// Of the library in a state of the weather, and of the models behind it.
SpecularSurfaces all_mirrors(const SceneDescription& scene,
                             const materials::MaterialLibrary& library,
                             const ModelMaterials& model_materials, materials::SurfaceState state) {
  SpecularSurfaces mirrors = specular_surfaces(scene, library, state);
  for (const ModelMaterials::Entry& entry : model_materials.all()) mirrors.push_back(entry.mirror);
  return mirrors;
}

void record_model_materials(const ModelMaterials& materials, Scene& scene) {
  const sensors::Waveform& waveform = scene.description.sensor.waveform;
  for (const ModelMaterials::Entry& entry : materials.all())
    scene.surfaces.push_back(
        {entry.name, entry.name, std::string(name_of(entry.surface)), "stated by the model's files",
         validity_of(entry.surface).grazing_rad,
         extrapolations_of(entry.surface, waveform.polarisation, waveform.frequency_Hz)});
  for (const std::filesystem::path& file : materials.files())
    scene.description.files.push_back(file);
}

// What is known before the world is built.
struct Planned {
  SightMap sight;
  renderer::SceneFacts facts;
  core::EffectPlan plan;
  double accuracy_grey = 0.0;
  double plan_s = 0.0;
};

Planned plan_scene(const SceneParts& parts, const atmosphere::Weather& weather,
                   const atmosphere::VolumeEcho& volume_echo, const BuildOptions& options) {
  const auto begin = Clock::now();
  Planned planned{
      {parts.ground, parts.patches, parts.meshes, mirroring_materials(parts.mirrors)}, {}, {}};
  const renderer::SceneFacts all = facts_of(parts, weather, volume_echo.largest_eta_m2_per_m3());
  planned.facts = sequence_facts(parts, all, planned.sight);
  planned.accuracy_grey = options.accuracy_grey > 0.0             ? options.accuracy_grey
                          : parts.description.accuracy_grey > 0.0 ? parts.description.accuracy_grey
                                                                  : kDefaultAccuracy_grey;
  planned.plan = renderer::plan(all, planned.facts, planned.accuracy_grey, options.wishes);
  planned.plan_s = seconds_since(begin);
  return planned;
}

void keep(Planned&& planned, const BuildOptions& options, Scene& scene) {
  scene.facts = std::move(planned.facts);
  scene.wishes = options.wishes;
  scene.accuracy_grey = planned.accuracy_grey;
  scene.plan_s = planned.plan_s;
  scene.sight = std::move(planned.sight);
}

std::vector<std::string> names_of(const materials::MaterialLibrary& library) {
  std::vector<std::string> names;
  for (const materials::Material& material : library.all()) names.push_back(material.name);
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

}  // namespace

renderer::FramePose Scene::pose_at(const core::Pose& pose) const { return pose_in(frame, pose); }

renderer::FramePose Scene::frame_pose(int frame_index) const {
  return scenes::frame_pose(frame, trajectory, description.sensor, frame_index);
}

std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems) {
  const auto begin = Clock::now();
  problems.throw_if_errors();
  const materials::MaterialLibrary library =
      materials::MaterialLibrary::from_file(description.material_library, problems);
  const MaterialNames names(library, problems);
  const terrain::LocalFrame frame(ellipsoidal_origin(description), description.earth);
  const Ground ground(description, frame, names, problems);
  std::vector<terrain::SurfacePatch> patches = build_patches(description, ground, names);
  ModelMaterials model_materials(description, library.size(), problems);
  Bodies bodies = build_bodies(description, ground, names, model_materials, problems);
  std::vector<renderer::PointTarget> targets = build_targets(description, ground, problems).points;
  const atmosphere::Weather weather = placed_weather(description, ground);
  std::optional<Trajectory> trajectory;
  if (!problems.has_errors()) trajectory = build_trajectory(description, ground, frame, problems);
  renderer::CasterChoice caster;
  if (trajectory)
    caster = scene_caster(
        description, options.caster,
        caster_facts(description.sensor, frame, *trajectory, ground.field(), bodies.solids),
        problems);
  check_surfaces(description, library, names.used(), problems);
  if (trajectory) check_flight(description, frame, *trajectory, ground.field(), problems);
  problems.throw_if_errors();

  const double frequency_Hz = description.sensor.waveform.frequency_Hz;
  const atmosphere::VolumeEcho volume_echo(weather, frequency_Hz);
  const std::vector<SpecularSurfaces> mirrors = {
      all_mirrors(description, library, model_materials, materials::SurfaceState::dry),
      all_mirrors(description, library, model_materials, description.surface_state)};
  Planned planned =
      plan_scene({description, frame, *trajectory, ground.field(), patches, bodies.meshes, targets,
                  library, names.used(), model_materials, mirrors},
                 weather, volume_echo, options);
  const core::EffectPlan plan = planned.plan;
  const bool wet = plan.runs(renderer::kSurfaceState);
  const materials::SurfaceState state =
      wet ? description.surface_state : materials::SurfaceState::dry;
  renderer::World world{
      .surfaces = std::make_unique<terrain::RayScene>(ground.field(), std::move(patches),
                                                      std::move(bodies.meshes),
                                                      options.instruction_set, options.robust),
      .nrcs = library.curves(state, description.sensor.waveform.polarisation, frequency_Hz),
      .material_names = names_of(library),
      .targets = std::move(targets),
      .attenuation = atmosphere::PathAttenuation(simulated_weather(weather, plan), frequency_Hz),
      .sensor = plan.runs(renderer::kSideLobes) ? description.sensor
                                                : renderer::without_side_lobes(description.sensor),
      .specular = mirrors[wet ? 1 : 0],
      .solids = std::move(bodies.solids)};
  add_rain(simulated_weather(weather, plan), plan, volume_echo, world);
  add_model_materials(model_materials, description.sensor.waveform, world);
  auto scene = std::make_unique<Scene>(
      Scene{description, frame, std::move(*trajectory), plan, std::move(world), 0.0});
  scene->raised_buildings = bodies.raised;
  scene->floating_buildings = bodies.floating;
  scene->caster = std::move(caster);
  scene->surfaces = record_surfaces(description, library, names.used(), state);
  if (planned.facts.has_walls || planned.facts.has_point_targets)
    report_mirrors(description, library, scene->surfaces, problems);
  record_model_materials(model_materials, *scene);
  scene->runways = runway_places(description, ground);
  keep(std::move(planned), options, *scene);
  scene->build_s = seconds_since(begin);
  return scene;
}

}  // namespace fanbeam::scenes
