#include "scenes/scene.h"

#include <chrono>
#include <cmath>

#include "materials/library/material_library.h"
#include "scenes/flight_window.h"
#include "scenes/ground.h"
#include "scenes/model_materials.h"
#include "scenes/objects.h"
#include "scenes/scene_caster.h"
#include "scenes/scene_names.h"
#include "scenes/scene_surfaces.h"
#include "scenes/trajectory/trajectory_builder.h"
#include "scenes/weather_placement.h"
#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

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
    const terrain::Runway& runway = ground.runways()[i];
    RunwayPlace place;
    place.width_m = runway.width_m;
    place.strip_half_width_m = runway.strip_half_width_m;
    for (const int end : {0, 1})
      place.ends[end] = {scene.runways[i].ends[end].name,
                         ground.on_ground_m(runway.threshold_m(end), 0.0),
                         ground.on_ground_m(runway.ends[end].pavement_end_m, 0.0)};
    places.push_back(std::move(place));
  }
  return places;
}

struct Library {
  materials::MaterialLibrary content;
  bool is_sound = false;
};

// Empty where the reader found no file, and told that.
Library library_of(const SceneDescription& scene, core::ProblemList& problems) {
  if (problems.has_errors() && scene.material_library.empty()) return {};
  core::ProblemList found;
  Library library{materials::MaterialLibrary::from_file(scene.material_library, found)};
  library.is_sound = !found.has_errors();
  problems.append(found.all());
  return library;
}

core::Geodetic ellipsoidal_origin(const SceneDescription& scene) {
  core::Geodetic origin = scene.origin;
  origin.height_m = terrain::ellipsoidal_height_m(origin, scene.datum);
  return origin;
}

void check_heights(const SceneDescription& scene, const FlightVolume& volume,
                   core::ProblemList& problems) {
  if (volume.lowest_m <= volume.highest_m) return;
  problems.error(core::ErrorClass::range, scene.flight_heights.place, "flight_volume",
                 core::number_text(std::round(volume.lowest_m)) + " to " +
                     core::number_text(std::round(volume.highest_m)) + " m above the origin",
                 "highest_m above lowest_m; what is not stated is the lowest ground, and the "
                 "highest with the sensor's range above it");
}

std::shared_ptr<const renderer::Geometry> geometry_of(const Ground& ground,
                                                      std::vector<terrain::SurfacePatch> patches,
                                                      Bodies bodies,
                                                      std::vector<std::string> material_names,
                                                      const BuildOptions& options) {
  return std::make_shared<renderer::Geometry>(renderer::Geometry{
      std::make_unique<terrain::RayScene>(ground.field(), std::move(patches), bodies.meshes,
                                          options.instruction_set, options.robust),
      std::move(bodies.solids), std::move(material_names), std::move(bodies.objects.names),
      std::move(bodies.objects.kinds), std::move(bodies.objects.models)});
}

}  // namespace

std::unique_ptr<Scene> build_scene(const SceneDescription& description, const BuildOptions& options,
                                   core::ProblemList& problems) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const bool read_well = !problems.has_errors();
  auto [library, is_sound] = library_of(description, problems);
  const MaterialNames names(library, problems, is_sound);
  check_names(description, names, read_well, problems);
  if (!read_well) problems.throw_if_errors();
  SceneSetting setting{description, options,
                       terrain::LocalFrame(ellipsoidal_origin(description), description.earth)};
  setting.description.place_of_key = nullptr;
  const std::size_t before = problems.errors();
  const Ground ground(description, setting.frame, names, problems);
  const bool can_land = problems.errors() == before && !problems.is_full();
  Objects objects;
  objects.add("terrain", renderer::ObjectKind::terrain);
  std::vector<terrain::SurfacePatch> patches =
      build_patches(description, ground, names, objects, problems);
  ModelMaterials model_materials(description, library.size(), problems);
  Bodies bodies =
      build_bodies(description, ground, names, model_materials, std::move(objects), problems);
  std::vector<renderer::PointTarget> targets = build_targets(description, ground, problems).points;
  setting.weather = placed_weather(description, ground);
  check_losses(setting.weather, problems);
  // An approach says nothing of itself where its runway is wrong, and nothing stands where no ground is.
  if (!ground.field().height_m.empty() &&
      (can_land || description.trajectory.kind != TrajectoryDescription::Kind::ils))
    setting.trajectory = build_trajectory(description, ground, setting.frame, problems);
  std::optional<SiteFacts> stands;
  if (!ground.field().height_m.empty()) {
    stands.emplace(ground.field(), patches, bodies.meshes);
    setting.volume =
        flight_volume(description, setting.frame, setting.trajectory, ground.field(), *stands);
    check_heights(description, setting.volume, problems);
    check_caster(description, options.caster, setting.volume, bodies.solids, problems);
  }
  check_surfaces(description, library, names.used(), problems);
  if (setting.trajectory) {
    check_flight(description, setting.frame, *setting.trajectory, ground.field(), problems);
    tell_standing_targets(description, *setting.trajectory, problems);
  }
  problems.throw_if_errors();

  setting.runways = runway_places(description, ground);
  setting.raised_buildings = bodies.raised;
  setting.floating_buildings = bodies.floating;
  for (const auto& files : {bodies.files, model_materials.files()})
    setting.description.files.insert(setting.description.files.end(), files.begin(), files.end());
  std::vector<std::string> material_names = names_of(library, model_materials);
  SightMap sight(ground.field(), patches, bodies.meshes);
  setting.site = std::make_shared<const Site>(Site::Parts{
      std::move(library), names.used(), model_materials.all(), std::move(sight), *stands,
      geometry_of(ground, std::move(patches), std::move(bodies), std::move(material_names),
                  options),
      description.sensor.waveform});
  std::unique_ptr<Scene> scene = settled(std::move(setting), std::move(targets), problems);
  scene->build_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return scene;
}

}  // namespace fanbeam::scenes
