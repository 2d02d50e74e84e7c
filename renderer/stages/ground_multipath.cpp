#include "renderer/stages/ground_multipath.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "materials/dielectric/specular_surface.h"
#include "renderer/surfaces/bistatic_nrcs.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "terrain/secondary_origin.h"

namespace fanbeam::renderer {
namespace {

// As for the direct path: the ground that a target stands on does not hide it.
constexpr double kClearance_m = 1.0;
constexpr int kMostSteps = 8;
constexpr double kClose_m = 0.01;

// What a surface scatters it does not mirror: as in renderer/surfaces/mirrors.h.
std::complex<double> reflection(const World& world, terrain::MaterialId material, double sine) {
  const std::complex<double> whole =
      materials::specular_reflection(*world.specular[material], world.sensor.waveform.polarisation,
                                     world.sensor.wavelength_m(), std::asin(sine));
  const std::vector<BistaticNrcs>& nrcs = world.nrcs.bistatic();
  const double left = material < nrcs.size() ? nrcs[material].unscattered(sine) : 1.0;
  const double power = std::norm(whole);
  return power > left ? whole * std::sqrt(left / power) : whole;
}

struct Plane {
  glm::dvec3 point_m{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};
};

struct Reflection {
  Plane plane;
  glm::dvec3 image_m{0.0};
  double sensor_above_m = 0.0, target_above_m = 0.0;
};

// The ground around a point, from heights one post to each side of it.
std::optional<Plane> plane_at(const terrain::HeightField& ground, double x_m, double y_m) {
  const double step_m = ground.spacing_m;
  const auto middle_m = ground.height_at(x_m, y_m);
  const auto west_m = ground.height_at(x_m - step_m, y_m);
  const auto east_m = ground.height_at(x_m + step_m, y_m);
  const auto south_m = ground.height_at(x_m, y_m - step_m);
  const auto north_m = ground.height_at(x_m, y_m + step_m);
  if (!middle_m || !west_m || !east_m || !south_m || !north_m) return std::nullopt;
  const glm::dvec3 normal(*west_m - *east_m, *south_m - *north_m, 2.0 * step_m);
  return Plane{{x_m, y_m, *middle_m}, glm::normalize(normal)};
}

std::optional<Reflection> reflection_point(const terrain::HeightField& ground,
                                           const glm::dvec3& sensor_m, const glm::dvec3& target_m) {
  const auto foot_m = ground.height_at(target_m.x, target_m.y);
  if (!foot_m) return std::nullopt;
  Reflection found{{{target_m.x, target_m.y, *foot_m}, {0.0, 0.0, 1.0}}, {}, 0.0, 0.0};
  for (int step = 0; step <= kMostSteps; ++step) {
    found.sensor_above_m = glm::dot(sensor_m - found.plane.point_m, found.plane.normal);
    found.target_above_m = glm::dot(target_m - found.plane.point_m, found.plane.normal);
    if (!(found.sensor_above_m > 0.0 && found.target_above_m > 0.0)) return std::nullopt;
    found.image_m = target_m - 2.0 * found.target_above_m * found.plane.normal;
    const glm::dvec3 at_m =
        sensor_m + (found.image_m - sensor_m) *
                       (found.sensor_above_m / (found.sensor_above_m + found.target_above_m));
    const glm::dvec3 moved_m = at_m - found.plane.point_m;
    // The first plane has only been guessed: one step at least.
    if (step == kMostSteps || (step > 0 && glm::dot(moved_m, moved_m) < kClose_m * kClose_m)) break;
    const std::optional<Plane> plane = plane_at(ground, at_m.x, at_m.y);
    if (!plane) return std::nullopt;
    found.plane = *plane;
  }
  return found;
}

}  // namespace

std::optional<GroundPath> ground_path(const World& world, const sensors::AntennaFrame& antenna,
                                      const glm::dvec3& target_m) {
  const terrain::RayScene& surfaces = world.surfaces();
  if (surfaces.terrain() == nullptr) return std::nullopt;
  const auto found = reflection_point(*surfaces.terrain(), antenna.position_m, target_m);
  if (!found) return std::nullopt;
  const glm::dvec3& at_m = found->plane.point_m;
  const terrain::MaterialId material = surfaces.surface_map()->material_at(at_m.x, at_m.y);
  if (material >= world.specular.size() || !world.specular[material]) return std::nullopt;
  const glm::dvec3 path_m = found->image_m - antenna.position_m;
  const double image_m = glm::length(path_m);
  const double direct_m = glm::distance(antenna.position_m, target_m);
  const double sine = std::min((found->sensor_above_m + found->target_above_m) / image_m, 1.0);
  const auto angles = sensors::angles(antenna, at_m - antenna.position_m, world.sensor);
  const auto direct = sensors::angles(antenna, target_m - antenna.position_m, world.sensor);
  if (!angles || !direct || !(direct_m > 0.0)) return std::nullopt;
  const sensors::Antenna& beams = world.sensor.antenna;
  const auto gain = [&](double elevation_rad) {
    return sensors::one_way_gain_with_side_lobes(beams.elevation,
                                                 elevation_rad - beams.boresight_elevation_rad);
  };
  const double direct_gain = gain(direct->elevation_rad);
  if (!(direct_gain > 0.0)) return std::nullopt;
  GroundPath path;
  path.amplitude = reflection(world, material, sine) *
                   std::sqrt(gain(angles->elevation_rad) / direct_gain) * (direct_m / image_m);
  path.longer_m = 4.0 * found->sensor_above_m * found->target_above_m / (image_m + direct_m);
  path.elevation_rad = angles->elevation_rad;
  if (path.amplitude == 0.0) return std::nullopt;
  const glm::dvec3 start_m = terrain::secondary_origin_m(at_m, found->plane.normal,
                                                         glm::distance(at_m, antenna.position_m));
  if (surfaces.occluded(start_m, antenna.position_m, 0.0) ||
      surfaces.occluded(start_m, target_m, kClearance_m))
    return std::nullopt;
  return path;
}

void add_with_ground(const World& world, const sensors::AntennaFrame& antenna,
                     const glm::dvec3& target_m, const core::Echo& direct, Multipath multipath,
                     std::vector<core::Echo>& echoes) {
  echoes.push_back(direct);
  if (multipath == Multipath::none) return;
  const std::optional<GroundPath> path = ground_path(world, antenna, target_m);
  if (!path) return;
  const double phase_rad = -2.0 * core::kPi * path->longer_m / world.sensor.wavelength_m();
  const std::complex<double> there = path->amplitude * std::polar(1.0, phase_rad);
  const std::array<std::complex<double>, 3> parts = {1.0, 2.0 * there, there * there};
  std::array<double, 3> range_m{};
  std::array<int, 3> cell{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    range_m[i] = direct.range_m + static_cast<double>(i) / 2.0 * path->longer_m;
    cell[i] = sensors::range_row(world.sensor.range, range_m[i]);
  }
  echoes.pop_back();
  for (std::size_t i = 0; i < parts.size();) {
    core::Echo echo = direct;
    echo.range_m = range_m[i];
    echo.elevation_rad +=
        static_cast<double>(i) / 2.0 * (path->elevation_rad - direct.elevation_rad);
    std::complex<double> amplitude = 0.0;
    double power = 0.0;
    const int shared = cell[i];
    for (; i < parts.size() && cell[i] == shared; ++i) {
      amplitude += parts[i];
      power += std::norm(parts[i]);
    }
    echo.power_W *= multipath == Multipath::coherent ? std::norm(amplitude) : power;
    echoes.push_back(echo);
  }
}

}  // namespace fanbeam::renderer
