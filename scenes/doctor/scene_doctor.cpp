#include "scenes/doctor/scene_doctor.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "core/median.h"
#include "core/units.h"
#include "materials/library/material_library.h"
#include "scenes/doctor/parts_private.h"
#include "scenes/model_materials.h"
#include "scenes/objects.h"

namespace fanbeam::scenes {
namespace {

std::string rounded(double value, double parts = 1.0) {
  return core::number_text(std::round(value * parts) / parts + 0.0);  // no -0
}

std::vector<Body> bodies_of(const SceneDescription& scene, const Ground& ground,
                            const MaterialNames& names, ModelMaterials& model_materials,
                            core::ProblemList& problems) {
  Bodies built = build_bodies(scene, ground, names, model_materials, {}, problems);
  std::vector<Body> bodies;
  const auto take = [&](const core::Place& place, const std::string& name, bool single,
                        bool floating) {
    if (bodies.size() < built.meshes.size())
      bodies.push_back({std::move(built.meshes[bodies.size()]), place_text(place) + ", " + name,
                        single, floating});
  };
  for (const BoxDescription& box : scene.boxes)
    take(box.place, "box \"" + box.name + "\"", true, false);
  for (const BuildingsDescription& buildings : scene.buildings)
    take(buildings.place, "buildings " + buildings.file.filename().string(), false, false);
  for (const ModelDescription& model : scene.models)
    take(model.place, "model \"" + model.name + "\"", true, model.above_ground_m > 0.0);
  return bodies;
}

std::vector<Sight> flight_of(const Scene& scene, const Ground& ground) {
  const sensors::Sensor& sensor = scene.description.sensor;
  std::vector<Sight> flight;
  for (int frame = 0; frame < scene.frame_count(); ++frame) {
    Sight sight{frame, renderer::antenna_of(sensor, scene.frame_pose(frame)), 0.0};
    const glm::dvec3& at_m = sight.antenna.position_m;
    sight.above_ground_m = at_m.z - ground.field().height_at(at_m.x, at_m.y).value_or(at_m.z);
    flight.push_back(sight);
  }
  return flight;
}

std::vector<Sight> spread(const std::vector<Sight>& flight) {
  const std::size_t count = std::min<std::size_t>(flight.size(), kMostSights);
  std::vector<Sight> chosen;
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(flight[(2 * i + 1) * flight.size() / (2 * count)]);
  return chosen;
}

double far_sine_of(const std::vector<Sight>& flight, const sensors::RangeGate& range) {
  std::vector<double> heights_m;
  for (const Sight& sight : flight) heights_m.push_back(sight.above_ground_m);
  if (heights_m.empty()) return 0.01;
  return std::clamp(core::median(std::move(heights_m)) / range.maximum_m(), 1e-3, 1.0);
}

}  // namespace

std::string place_text(const core::Place& place) {
  const std::string name = std::filesystem::path(place.file).filename().string();
  return place.line > 0 ? name + ":" + std::to_string(place.line) : name;
}

std::string place_text(const Scene& scene, const glm::dvec3& position_m) {
  const core::Geodetic at = scene.frame.to_geodetic(position_m);
  return rounded(position_m.x) + " m east, " + rounded(position_m.y) + " m north of the origin (" +
         rounded(core::degrees(at.latitude_rad), 1e5) + ", " +
         rounded(core::degrees(at.longitude_rad), 1e5) + ")";
}

double float_step_m(const DoctorParts& parts, const glm::dvec3& point_m) {
  const glm::dvec3 at_m = glm::abs(parts.in_caster_m(point_m));
  return std::max({at_m.x, at_m.y, at_m.z}) *
         static_cast<double>(std::numeric_limits<float>::epsilon());
}

double range_in_view_m(const DoctorParts& parts, const Sight& sight, const glm::dvec3& point_m) {
  const sensors::Sensor& sensor = parts.sensor();
  const glm::dvec3 path_m = point_m - sight.antenna.position_m;
  const double range_m = std::sqrt(path_m.x * path_m.x + path_m.y * path_m.y + path_m.z * path_m.z);
  if (range_m < sensor.range.minimum_m || range_m > sensor.range.maximum_m()) return 0.0;
  const auto angles = sensors::all_round_angles(sight.antenna, path_m);
  const bool inside =
      angles && std::abs(angles->azimuth_rad) <= sensor.scan.field_of_view_rad / 2.0;
  return inside ? range_m : 0.0;
}

Findings examine(const Scene& scene, const std::vector<core::Problem>& warnings) {
  core::ProblemList problems;  // the scene was built: there are none but the warnings known
  const SceneDescription& description = scene.description;
  const materials::MaterialLibrary library =
      materials::MaterialLibrary::from_file(description.material_library, problems);
  const MaterialNames names(library, problems);
  const Ground ground(description, scene.frame, names, problems);
  const NaturalGround natural(description.terrain, ground.level_m(), names, problems);
  ModelMaterials model_materials(description, library.size(), problems);
  DoctorParts parts{scene, warnings, ground, natural, {}, {}, {}, {}};
  parts.bodies = bodies_of(description, ground, names, model_materials, problems);
  parts.point_groups = build_targets(description, ground, problems).groups;
  problems.throw_if_errors();
  parts.flight = flight_of(scene, ground);
  parts.sights = spread(parts.flight);
  parts.far_sine = far_sine_of(parts.flight, parts.sensor().range);

  Findings findings;
  for (const auto& check :
       {check_flight_height, check_coordinates, check_runways, check_overlays, check_duplicates,
        check_triangle_sizes, check_voids, check_terrain_extent, check_targets, check_wires,
        check_thin_bodies, check_accuracy, check_grazing})
    check(parts, findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

void add_in_order(Findings& findings, Finding finding) {
  const auto place = std::find_if(findings.begin(), findings.end(), [&](const Finding& other) {
    return other.severity < finding.severity;
  });
  findings.insert(place, std::move(finding));
}

}  // namespace fanbeam::scenes
