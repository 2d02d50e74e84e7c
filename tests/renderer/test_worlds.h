// Small worlds with known answers.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/frame_renderer.h"
#include "sensors/sensor_file.h"

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

inline atmosphere::PathAttenuation clear_air() {
  atmosphere::Weather weather;
  weather.simulate_gas = weather.simulate_fog = weather.simulate_rain = false;
  return {weather, 35e9};
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

inline renderer::World world(const sensors::Sensor& sensor,
                             std::optional<terrain::HeightField> field,
                             std::vector<materials::NrcsCurve> nrcs,
                             std::vector<terrain::PlacedMesh> meshes = {},
                             std::vector<terrain::SurfacePatch> patches = {}) {
  return {.surfaces = std::make_unique<terrain::RayScene>(std::move(field), std::move(patches),
                                                          std::move(meshes)),
          .nrcs = std::move(nrcs),
          .attenuation = clear_air(),
          .sensor = sensor};
}

// Level, heading north, `height_m` above the origin.
inline renderer::FramePose level_pose(double height_m) {
  renderer::FramePose pose;
  pose.position_m = {0.0, 0.0, height_m};
  pose.north_east_down = {{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  return pose;
}

// A closed box on the ground as a mesh of one material.
inline terrain::PlacedMesh box(glm::dvec3 low, glm::dvec3 high, terrain::MaterialId material) {
  terrain::PlacedMesh placed;
  for (int i = 0; i < 8; ++i)
    placed.mesh.vertices_m.emplace_back((i & 1) != 0 ? high.x : low.x,
                                        (i & 2) != 0 ? high.y : low.y,
                                        (i & 4) != 0 ? high.z : low.z);
  placed.mesh.triangles = {{0, 1, 5}, {0, 5, 4}, {1, 3, 7}, {1, 7, 5}, {3, 2, 6},
                           {3, 6, 7}, {2, 0, 4}, {2, 4, 6}, {4, 5, 7}, {4, 7, 6}};
  placed.mesh.triangle_material.assign(placed.mesh.triangles.size(), 0);
  placed.mesh.material_names = {"box"};
  placed.material_of_name = {material};
  return placed;
}

}  // namespace fanbeam::tests
