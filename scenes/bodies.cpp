#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/spelling.h"
#include "scenes/city_bodies.h"
#include "scenes/file_budget.h"
#include "scenes/objects.h"
#include "scenes/placed_problems.h"
#include "terrain/buildings/cityjson.h"
#include "terrain/buildings/extrusion.h"
#include "terrain/buildings/footprints.h"
#include "terrain/buildings/solid_prisms.h"
#include "terrain/gltf/gltf_loader.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using renderer::ObjectKind;
using terrain::PlacedMesh;

struct GroundSpan {
  double lowest_m = 1e300, mean_m = 0.0;
  bool covered = true;
};

GroundSpan ground_under(const Ground& ground, const terrain::Ring_m& ring) {
  GroundSpan span;
  for (const glm::dvec2& corner : ring) {
    const auto height_m = ground.field().height_at(corner.x, corner.y);
    span.covered = span.covered && height_m.has_value();
    span.lowest_m = std::min(span.lowest_m, height_m.value_or(0.0));
    span.mean_m += height_m.value_or(0.0) / static_cast<double>(ring.size());
  }
  return span;
}

std::vector<terrain::MaterialId> ids_of(const terrain::TriangleMesh& mesh,
                                        const MaterialNames& names, const core::Place& place,
                                        const std::string& field) {
  std::vector<terrain::MaterialId> ids;
  for (const std::string& name : mesh.material_names) ids.push_back(names.id(name, place, field));
  return ids;
}

// `object` by prism.
void add_prisms(const std::vector<terrain::Prism>& prisms, terrain::Extrusion extrusion,
                std::vector<terrain::ObjectId> object, const MaterialNames& names,
                const core::Place& place, const std::string& field, Bodies& bodies) {
  std::vector<terrain::MaterialId> ids = ids_of(extrusion.mesh, names, place, field);
  for (const terrain::ExtrudedPolygon& polygon : extrusion.polygons)
    bodies.raised += prisms[polygon.prism].on_ground ? 0 : 1;
  bodies.floating += terrain::add_solids(prisms, extrusion, ids[terrain::kWallSlot],
                                         ids[terrain::kRoofSlot], object, bodies.solids);
  bodies.meshes.push_back({std::move(extrusion.mesh), std::move(ids), std::move(object)});
}

void add_box(const BoxDescription& box, const Ground& ground, const MaterialNames& names,
             core::ProblemList& problems, Bodies& bodies) {
  const auto centre_m = ground.local_m(box.at);
  if (!centre_m) return;
  const glm::dvec2 along =
      glm::dvec2(std::sin(box.heading_rad), std::cos(box.heading_rad)) * (box.length_m / 2);
  const glm::dvec2 side =
      glm::dvec2(std::cos(box.heading_rad), -std::sin(box.heading_rad)) * (box.width_m / 2);
  terrain::Prism prism;
  prism.outer_m = {*centre_m - along - side, *centre_m - along + side, *centre_m + along + side,
                   *centre_m + along - side};
  const GroundSpan span = ground_under(ground, prism.outer_m);
  if (!span.covered)
    return problems.error(ErrorClass::range, box.place, "box",
                          "\"" + box.name + "\" reaches beyond the terrain",
                          "corners on the scene's terrain");
  prism.bottom_m = span.lowest_m - kFoundation_m;
  prism.top_m = ground.on_ground_m(*centre_m, box.height_m).z;
  terrain::Extrusion extrusion =
      terrain::extrude({prism}, box.name, {box.wall_material, box.roof_material}, problems);
  add_prisms({prism}, std::move(extrusion), {bodies.objects.add(box.name, ObjectKind::box)}, names,
             box.place, "box", bodies);
}

// Footprints beyond the terrain are left out with a warning.
std::vector<terrain::Prism> prisms_of(const BuildingsDescription& buildings, const Ground& ground,
                                      core::ProblemList& problems) {
  const std::vector<terrain::Footprint> footprints = terrain::read_footprints(
      buildings.file, {buildings.height_property, buildings.min_height_property}, problems);
  std::vector<terrain::Prism> prisms;
  std::size_t outside = 0;
  for (const terrain::Footprint& footprint : footprints) {
    const auto ring_m = [&](const terrain::GeodeticRing& ring) {
      terrain::Ring_m local_m;
      for (const terrain::GeodeticPoint& point : ring)
        local_m.push_back(ground.local_m(point.latitude_rad, point.longitude_rad));
      return local_m;
    };
    terrain::Prism prism;
    prism.outer_m = ring_m(footprint.outer);
    const GroundSpan span = ground_under(ground, prism.outer_m);
    if (!span.covered) {
      ++outside;
      continue;
    }
    for (const terrain::GeodeticRing& hole : footprint.holes) prism.holes_m.push_back(ring_m(hole));
    const double base_m = buildings.base_is_mean ? span.mean_m : span.lowest_m;
    prism.top_m = base_m + footprint.height_m;
    prism.on_ground = !(footprint.min_height_m > 0.0);
    prism.bottom_m =
        prism.on_ground ? span.lowest_m - kFoundation_m : base_m + footprint.min_height_m;
    if (prism.top_m > prism.bottom_m) prisms.push_back(std::move(prism));
  }
  if (outside > 0)
    problems.warning("OUTSIDE", buildings.place, "buildings",
                     std::to_string(outside) + " footprints",
                     "not on the scene's terrain, left out");
  return prisms;
}

void add_footprints(const BuildingsDescription& buildings, const Ground& ground,
                    const MaterialNames& names, core::ProblemList& problems, Bodies& bodies) {
  const std::vector<terrain::Prism> prisms = prisms_of(buildings, ground, problems);
  terrain::Extrusion city =
      terrain::extrude(prisms, buildings.file.filename().string(),
                       {buildings.wall_material, buildings.roof_material}, problems);
  std::vector<terrain::ObjectId> objects;
  for (std::size_t i = 0; i < prisms.size(); ++i)
    objects.push_back(bodies.objects.add(
        buildings.file.filename().string() + " " + std::to_string(i + 1), ObjectKind::building));
  add_prisms(prisms, std::move(city), std::move(objects), names, buildings.place,
             "buildings, the default", bodies);
}

void add_buildings(const BuildingsDescription& buildings, const Ground& ground,
                   const MaterialNames& names, FileBudget& budget, core::ProblemList& problems,
                   Bodies& bodies) {
  const std::string text = budget.read(buildings.file, terrain::kLargestCityFile_bytes);
  const bool is_city = terrain::is_cityjson(text);
  for (const auto& key : is_city ? buildings.footprint_keys : buildings.city_keys)
    problems.error(ErrorClass::unsupported, key.place, key.path,
                   is_city ? "a key of GeoJSON footprints" : "a key of CityJSON",
                   "no such key: " + buildings.file.filename().string() +
                       (is_city ? " is" : " is no") + " CityJSON");
  if (is_city)
    add_city(text, buildings, ground, names, problems, bodies);
  else
    add_footprints(buildings, ground, names, problems, bodies);
}

void add_model(const ModelDescription& model, const Ground& ground, const MaterialNames& names,
               ModelMaterials& model_materials, FileBudget& budget, core::ProblemList& problems,
               Bodies& bodies) {
  const auto at_m = ground.local_m(model.at);
  if (!at_m) return;
  PlacedMesh placed;
  placed.mesh = terrain::load_gltf(model.file, model.root, problems,
                                   [&](const std::filesystem::path& file, std::uint64_t most) {
                                     return budget.read(file, most);
                                   });
  const glm::dvec3 base_m = model.height_m ? ground.at_height_m(*at_m, *model.height_m)
                                           : ground.on_ground_m(*at_m, model.above_ground_m);
  const glm::dvec3 forward(std::sin(model.heading_rad), std::cos(model.heading_rad), 0.0);
  const glm::dvec3 right(std::cos(model.heading_rad), -std::sin(model.heading_rad), 0.0);
  for (glm::dvec3& vertex : placed.mesh.vertices_m)
    vertex = base_m + right * vertex.x + forward * vertex.y + glm::dvec3(0.0, 0.0, vertex.z);
  for (const std::string& name : placed.mesh.material_names) {
    const auto mapped = model.materials.find(name);
    const bool overridden = mapped != model.materials.end();
    std::optional<terrain::MaterialId> id;
    if (!overridden) id = model_materials.id(model, name);
    if (!id)
      id = names.id(overridden ? mapped->second : model.default_material, model.place,
                    overridden ? "model.materials" : "model.default_material, the default");
    placed.material_of_name.push_back(*id);
  }
  for (const auto& [name, material] : model.materials) {
    const auto& used = placed.mesh.material_names;
    const bool listed = problems.all().size() < core::ProblemList::kMost;
    if (listed && std::find(used.begin(), used.end(), name) == used.end())
      problems.warning("UNUSED", model.place, "model.materials", "\"" + name + "\"",
                       "no triangle of " + model.file.filename().string() + " has this material" +
                           core::names_there_text(name, used));
  }
  bodies.objects.models.push_back({model.name,
                                   static_cast<terrain::ObjectId>(bodies.objects.names.size()),
                                   placed.mesh.part_names.size()});
  for (const std::string& part : placed.mesh.part_names)
    placed.object_of_part.push_back(
        bodies.objects.add(model.name + ": " + part, ObjectKind::model));
  if (!placed.mesh.vertices_m.empty())
    bodies.solids.others.push_back(terrain::box_around(placed.mesh));
  bodies.meshes.push_back(std::move(placed));
}

}  // namespace

terrain::ObjectId Objects::add(const std::string& name, ObjectKind kind) {
  names.push_back(name);
  kinds.push_back(kind);
  return static_cast<terrain::ObjectId>(names.size() - 1);
}

Bodies build_bodies(const SceneDescription& scene, const Ground& ground, const MaterialNames& names,
                    ModelMaterials& model_materials, Objects objects, core::ProblemList& problems,
                    std::size_t most_triangles) {
  Bodies bodies;
  bodies.objects = std::move(objects);
  FileBudget budget;
  std::size_t counted = 0;  // meshes
  std::size_t triangles = 0;
  const auto guarded = [&](const core::Place& place, const char* field, auto&& add) {
    if (triangles > most_triangles) return;
    try {
      add();
    } catch (const core::InputError& error) {
      append_placed(problems, error, place, field);
    }
    for (; counted < bodies.meshes.size(); ++counted)
      triangles += bodies.meshes[counted].mesh.triangles.size();
    if (triangles > most_triangles)
      problems.error(
          ErrorClass::limit, place, field, std::to_string(triangles) + " triangles",
          "at most " + std::to_string(most_triangles) + " in all boxes, buildings and models");
  };
  for (const BoxDescription& box : scene.boxes)
    guarded(box.place, "box", [&] { add_box(box, ground, names, problems, bodies); });
  for (const BuildingsDescription& buildings : scene.buildings)
    guarded(buildings.place, "buildings",
            [&] { add_buildings(buildings, ground, names, budget, problems, bodies); });
  for (const ModelDescription& model : scene.models)
    guarded(model.place, "model",
            [&] { add_model(model, ground, names, model_materials, budget, problems, bodies); });
  bodies.files.assign(budget.files().begin(), budget.files().end());
  return bodies;
}

}  // namespace fanbeam::scenes
