// What a frame is made of beside its pose: geometry, and the conditions that it is seen under.
//
// The geometry is shared, so that a world under other conditions (another rain, targets elsewhere)
// costs a copy of the rest: milliseconds.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atmosphere/path_attenuation.h"
#include "atmosphere/precipitation/rain_cells.h"
#include "atmosphere/volume_echo.h"
#include "core/swerling.h"
#include "materials/dielectric/specular_surface.h"
#include "materials/rcs/rcs.h"
#include "renderer/geometry.h"
#include "renderer/surfaces/reflectivity.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// A point scatterer, standing (one waypoint) or moving along straight legs between waypoints;
// before the first and after the last one it stands there. Positions in local metres.
struct PointTarget {
  struct Waypoint {
    double time_s = 0.0;
    glm::dvec3 position_m{0.0};
  };
  std::string name;
  materials::RcsModel rcs;
  std::vector<Waypoint> path;
  glm::dmat3 axes{1.0};  // columns: the target's x (boresight), y and z axes in scene axes
  core::Swerling swerling = core::Swerling::steady;

  glm::dvec3 position_at(double time_s) const;
  // Of the leg that it is on, m/s; 0 before the first waypoint and from the last one.
  glm::dvec3 velocity_at(double time_s) const;
};

struct World {
  std::shared_ptr<const Geometry> geometry;
  Reflectivity nrcs{};  // by material id, as the sensor sees them
  std::vector<PointTarget> targets{};
  atmosphere::PathAttenuation attenuation;
  sensors::Sensor sensor;
  // By material id; materials beyond the end, and empty ones, do not reflect like a mirror.
  std::vector<std::optional<materials::SpecularSurface>> specular{};
  std::optional<atmosphere::VolumeEcho> volume_echo{};  // where the effect rain echo runs
  std::optional<atmosphere::RainCells> rain_cells{};    // what they take beyond `attenuation`

  const terrain::RayScene& surfaces() const { return *geometry->surfaces; }
  const terrain::Solids& solids() const { return geometry->solids; }
};

}  // namespace fanbeam::renderer
