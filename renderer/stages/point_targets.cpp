#include "renderer/stages/point_targets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "core/parallel.h"
#include "renderer/stages/echo_shares.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// A light stands 0.3 m above ground that is known to 0.1 m: nearer than this the ground does not
// hide it.
constexpr double kClearance_m = 1.0;

}  // namespace

glm::dvec3 PointTarget::position_at(double time_s) const {
  if (time_s <= path.front().time_s) return path.front().position_m;
  if (time_s >= path.back().time_s) return path.back().position_m;
  const auto after = std::upper_bound(
      path.begin(), path.end(), time_s,
      [](double time, const Waypoint& waypoint) { return time < waypoint.time_s; });
  const Waypoint& a = *(after - 1);
  const Waypoint& b = *after;
  return a.position_m +
         (b.position_m - a.position_m) * ((time_s - a.time_s) / (b.time_s - a.time_s));
}

namespace {

std::optional<core::Echo> echo_of(const World& world, const sensors::AntennaFrame& antenna,
                                  double time_s, std::size_t index) {
  const sensors::Sensor& sensor = world.sensor;
  const sensors::Antenna& beams = sensor.antenna;
  const PointTarget& target = world.targets[index];
  const glm::dvec3 position_m = target.position_at(time_s);
  const glm::dvec3 path_m = position_m - antenna.position_m;
  const double range_m = glm::length(path_m);
  if (range_m < sensor.range.minimum_m || range_m >= sensor.range.maximum_m()) return std::nullopt;
  const glm::dvec3 direction = path_m / range_m;
  const auto angles = sensors::angles(antenna, direction, sensor.scan.surface);
  if (!angles) return std::nullopt;
  const double reach_rad = sensor.scan.field_of_view_rad / 2 + sensors::reach_rad(beams.azimuth);
  if (std::abs(angles->azimuth_rad) > reach_rad) return std::nullopt;
  const double elevation_gain = sensors::two_way_gain_with_side_lobes(
      beams.elevation, angles->elevation_rad - beams.boresight_elevation_rad);
  const double rcs_m2 = materials::rcs_m2(target.rcs, glm::transpose(target.axes) * -direction,
                                          sensor.wavelength_m());
  if (!(elevation_gain * rcs_m2 > 0.0)) return std::nullopt;
  if (world.surfaces->occluded(antenna.position_m, position_m, kClearance_m)) return std::nullopt;
  core::Echo echo;
  echo.range_m = range_m;
  echo.azimuth_rad = angles->azimuth_rad;
  echo.elevation_rad = angles->elevation_rad;
  echo.object_id = static_cast<std::uint32_t>(index);
  echo.power_W =
      sensor.radar_constant_W_m2() * rcs_m2 * elevation_gain *
      world.attenuation.two_way_power_factor(antenna.position_m.z, position_m.z, range_m) /
      (range_m * range_m * range_m * range_m);
  if (world.rain_cells)
    echo.power_W *= world.rain_cells->two_way_power_factor(antenna.position_m, position_m);
  return echo;
}

}  // namespace

std::vector<core::Echo> point_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                     double time_s, Multipath multipath) {
  constexpr std::size_t kAtOnce = 64;
  const std::size_t count = world.targets.size();
  std::vector<std::vector<core::Echo>> found((count + kAtOnce - 1) / kAtOnce);
  core::parallel_for(found.size(), [&](std::size_t block) {
    for (std::size_t i = block * kAtOnce; i < std::min((block + 1) * kAtOnce, count); ++i)
      if (const auto echo = echo_of(world, antenna, time_s, i))
        add_with_ground(world, antenna, world.targets[i].position_at(time_s), *echo, multipath,
                        found[block]);
  });
  std::vector<core::Echo> echoes;
  for (const std::vector<core::Echo>& block : found)
    echoes.insert(echoes.end(), block.begin(), block.end());
  return echoes;
}

void add_echoes(const std::vector<core::Echo>& echoes, const sensors::Sensor& sensor,
                std::vector<double>& bscope_W, std::vector<double>& cscope_W_m3) {
  const int columns = sensor.scan.columns;
  for (const core::Echo& echo : echoes) {
    const int row = cscope_W_m3.empty() ? sensors::kOutside
                                        : sensors::cscope_row(sensor.display, echo.elevation_rad);
    share_echo(echo, sensor, [&](int cell, int column, double power_W) {
      bscope_W[static_cast<std::size_t>(cell * columns + column)] += power_W;
      if (row != sensors::kOutside)
        cscope_W_m3[static_cast<std::size_t>(row * columns + column)] +=
            power_W * echo.range_m * echo.range_m * echo.range_m;
    });
  }
}

}  // namespace fanbeam::renderer
