#include "scenes/city_bodies.h"

#include <algorithm>
#include <utility>

#include "core/spelling.h"
#include "terrain/buildings/cityjson.h"
#include "terrain/buildings/solid_prisms.h"

namespace fanbeam::scenes {
namespace {

// Corners so near to a building's lowest belong to its foot.
constexpr double kFoot_m = 0.1;

const std::string& material_of(const std::string& surface, const BuildingsDescription& buildings) {
  const auto named = buildings.surface_materials.find(surface);
  if (named != buildings.surface_materials.end()) return named->second;
  const bool above = surface == "RoofSurface" || surface == "OuterFloorSurface";
  return above ? buildings.roof_material : buildings.wall_material;
}

// False, and the building as it was, where it stands beyond the terrain.
bool put_on_ground(terrain::CityBuilding& building, bool heights_as_filed, const Ground& ground) {
  double lowest_m = 1e300, lowest_ground_m = 1e300;
  for (const glm::dvec3& vertex : building.vertices_m) {
    const auto ground_m = ground.field().height_at(vertex.x, vertex.y);
    if (!ground_m) return false;
    lowest_m = std::min(lowest_m, vertex.z);
    lowest_ground_m = std::min(lowest_ground_m, *ground_m);
  }
  if (heights_as_filed) return true;
  for (glm::dvec3& vertex : building.vertices_m) {
    const bool foot = vertex.z < lowest_m + kFoot_m;
    vertex.z += lowest_ground_m - lowest_m - (foot ? kFoundation_m : 0.0);
  }
  return true;
}

void append(const terrain::CityBuilding& building, terrain::TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(), building.vertices_m.begin(),
                         building.vertices_m.end());
  for (const glm::uvec3& triangle : building.triangles)
    mesh.triangles.push_back(triangle + glm::uvec3(first));
  mesh.triangle_material.insert(mesh.triangle_material.end(), building.triangle_surface.begin(),
                                building.triangle_surface.end());
  mesh.triangle_part.resize(mesh.triangles.size(),
                            static_cast<std::uint32_t>(mesh.part_names.size()));
  mesh.part_names.push_back(building.id);
}

}  // namespace

void add_city(const std::string& text, const BuildingsDescription& buildings, const Ground& ground,
              const MaterialNames& names, core::ProblemList& problems, Bodies& bodies) {
  const std::string file = buildings.file.filename().string();
  terrain::CityModel city = terrain::read_cityjson(
      text, buildings.file.string(),
      {buildings.crs, [&](const core::Geodetic& position) { return ground.local_m(position); }},
      problems);
  terrain::PlacedMesh placed;
  placed.mesh.name = file;
  placed.mesh.material_names = city.surfaces;
  std::size_t outside = 0;
  for (terrain::CityBuilding& building : city.buildings) {
    if (put_on_ground(building, buildings.heights_as_filed, ground))
      append(building, placed.mesh);
    else
      ++outside;
  }
  if (outside > 0)
    problems.warning("OUTSIDE", buildings.place, "buildings",
                     std::to_string(outside) + " buildings",
                     "not on the scene's terrain, left out");
  for (const auto& [surface, material] : buildings.surface_materials)
    if (std::find(city.surfaces.begin(), city.surfaces.end(), surface) == city.surfaces.end())
      problems.warning("UNUSED", buildings.place, "buildings.surfaces", "\"" + surface + "\"",
                       "no surface of " + file + " has this name" +
                           core::names_there_text(surface, city.surfaces));
  if (placed.mesh.triangles.empty()) return;
  terrain::check_and_clean(placed.mesh, file, problems);
  for (const std::string& surface : placed.mesh.material_names)
    placed.material_of_name.push_back(
        names.id(material_of(surface, buildings), buildings.place, "buildings, the default"));
  for (const std::string& part : placed.mesh.part_names)
    placed.object_of_part.push_back(
        bodies.objects.add(file + " " + part, renderer::ObjectKind::building));
  add_boxes(placed.mesh, bodies.solids);
  bodies.meshes.push_back(std::move(placed));
}

}  // namespace fanbeam::scenes
