// Small worlds with known answers.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "core/pose.h"
#include "renderer/frame.h"
#include "sensors/sensor_file.h"
#include "terrain/buildings/solid_prisms.h"

namespace fanbeam::tests {

// The shipped HiVision with its field of view cut to `columns` columns, so that references stay
// affordable.
inline sensors::Sensor hivision(int columns = 164) {
  core::ProblemList problems;
  sensors::Sensor sensor =
      sensors::read_sensor(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", problems);
  problems.throw_if_errors();
  sensor.scan.field_of_view_rad *= static_cast<double>(columns) / sensor.scan.columns;
  sensor.scan.columns = columns;
  return sensor;
}

// Ranges to 900 m: rays are slow.
inline sensors::Sensor narrow(int columns) {
  sensors::Sensor sensor = hivision(columns);
  sensor.range.cells = 105;
  return sensor;
}

inline atmosphere::PathAttenuation clear_air() {
  atmosphere::Weather weather;
  weather.simulate_gas = weather.simulate_fog = weather.simulate_rain = false;
  return {weather, 35e9};
}

// One-sided, facing the side from which its corners run counter-clockwise.
inline terrain::PlacedMesh quad(const std::array<glm::dvec3, 4>& corners_m,
                                terrain::MaterialId material) {
  terrain::PlacedMesh placed;
  placed.mesh.vertices_m.assign(corners_m.begin(), corners_m.end());
  placed.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  placed.mesh.triangle_material.assign(2, 0);
  placed.mesh.material_names = {"quad"};
  placed.material_of_name = {material};
  return placed;
}

// Ground of one material whose height is a function of east and north.
inline terrain::HeightField ground(double half_extent_m, double spacing_m,
                                   const std::function<double(double, double)>& height_m) {
  terrain::HeightField field = terrain::make_height_field(-half_extent_m, -half_extent_m,
                                                          half_extent_m, half_extent_m, spacing_m);
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i)
      field.height_m[field.post(i, j)] =
          height_m(field.west_m + spacing_m * i, field.south_m + spacing_m * j);
  return field;
}

// Something on the ground for both casters.
struct Body {
  // Any mesh: no solid, only a box around it.
  Body(terrain::PlacedMesh placed) : mesh(std::move(placed)) {
    solids.others = {terrain::box_around(mesh.mesh)};
  }
  Body(terrain::PlacedMesh placed, terrain::Solids cut)
      : mesh(std::move(placed)), solids(std::move(cut)) {}

  terrain::PlacedMesh mesh;
  terrain::Solids solids;
};

inline Body building(const terrain::Prism& prism, terrain::MaterialId wall,
                     terrain::MaterialId roof) {
  core::ProblemList problems;
  terrain::Extrusion extrusion = terrain::extrude({prism}, "building", {}, problems);
  problems.throw_if_errors();
  terrain::Solids solids;
  terrain::add_solids({prism}, extrusion, wall, roof, {}, solids);
  return {{std::move(extrusion.mesh), {wall, roof}}, std::move(solids)};
}

// A closed box on the ground of one material.
inline Body box(glm::dvec3 low, glm::dvec3 high, terrain::MaterialId material) {
  return building({{low, {high.x, low.y}, high, {low.x, high.y}}, {}, low.z, high.z}, material,
                  material);
}

inline std::shared_ptr<const renderer::Geometry> geometry(
    std::optional<terrain::HeightField> field, std::vector<terrain::SurfacePatch> patches = {},
    std::vector<terrain::PlacedMesh> meshes = {}, terrain::Solids solids = {},
    const std::string& instruction_set = "") {
  return std::make_shared<renderer::Geometry>(
      renderer::Geometry{std::make_unique<terrain::RayScene>(std::move(field), std::move(patches),
                                                             std::move(meshes), instruction_set),
                         std::move(solids)});
}

inline renderer::World world(const sensors::Sensor& sensor,
                             std::optional<terrain::HeightField> field,
                             std::vector<materials::NrcsCurve> nrcs, std::vector<Body> bodies = {},
                             std::vector<terrain::SurfacePatch> patches = {}) {
  std::vector<terrain::PlacedMesh> meshes;
  terrain::Solids solids;
  for (Body& body : bodies) {
    for (terrain::Solid& solid : body.solids.prisms) {
      if (body.mesh.object_of_part.size() == 1) solid.object = body.mesh.object_of_part.front();
      solids.prisms.push_back(std::move(solid));
    }
    meshes.push_back(std::move(body.mesh));
    for (const terrain::Box_m& other : body.solids.others) solids.others.push_back(other);
  }
  return {.geometry =
              geometry(std::move(field), std::move(patches), std::move(meshes), std::move(solids)),
          .nrcs = std::move(nrcs),
          .attenuation = clear_air(),
          .sensor = sensor};
}

// Of a world made here, to stand other things in it.
inline terrain::Solids& solids_of(renderer::World& world) {
  return const_cast<terrain::Solids&>(world.geometry->solids);
}

// Level, heading north, `height_m` above the origin.
inline renderer::FramePose level_pose(double height_m) {
  renderer::FramePose pose;
  pose.position_m = {0.0, 0.0, height_m};
  pose.north_east_down = {{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  return pose;
}

}  // namespace fanbeam::tests
