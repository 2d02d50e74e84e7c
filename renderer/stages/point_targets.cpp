#include "renderer/stages/point_targets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "core/parallel.h"
#include "renderer/stages/echo_shares.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/antenna/column_place.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// The waypoint that ends the leg at a time between the first and the last waypoint.
auto end_of_leg(const std::vector<PointTarget::Waypoint>& path, double time_s) {
  return std::upper_bound(path.begin(), path.end(), time_s,
                          [](double time, const auto& waypoint) { return time < waypoint.time_s; });
}

}  // namespace

glm::dvec3 PointTarget::position_at(double time_s) const {
  if (time_s <= path.front().time_s) return path.front().position_m;
  if (time_s >= path.back().time_s) return path.back().position_m;
  const auto b = end_of_leg(path, time_s), a = b - 1;
  return a->position_m +
         (b->position_m - a->position_m) * ((time_s - a->time_s) / (b->time_s - a->time_s));
}

glm::dvec3 PointTarget::velocity_at(double time_s) const {
  if (time_s < path.front().time_s || time_s >= path.back().time_s) return glm::dvec3(0.0);
  const auto b = end_of_leg(path, time_s), a = b - 1;
  return (b->position_m - a->position_m) / (b->time_s - a->time_s);
}

namespace {

// Where a target stands that has an echo, and how bright.
struct View {
  glm::dvec3 position_m{0.0};
  double range_m = 0.0;
  sensors::AntennaAngles angles{};
  double rcs_m2 = 0.0;
  double elevation_gain = 0.0;  // two-way
};

bool in_gate(const sensors::RangeGate& gate, double range_m) {
  return range_m >= gate.minimum_m && range_m < gate.maximum_m();
}

// Counts a target that has no direction.
std::optional<View> view_of(const sensors::Sensor& sensor, const PointTarget& target,
                            const sensors::AntennaFrame& antenna, double time_s,
                            std::uint64_t& unprojected) {
  const sensors::Antenna& beams = sensor.antenna;
  View view;
  view.position_m = target.position_at(time_s);
  const glm::dvec3 path_m = view.position_m - antenna.position_m;
  const auto angles = sensors::angles(antenna, path_m, sensor);
  if (!angles) {
    ++unprojected;
    return std::nullopt;
  }
  view.angles = *angles;
  view.range_m = glm::length(path_m);
  if (!in_gate(sensor.range, view.range_m)) return std::nullopt;
  if (!sensors::in_columns(sensor, angles->azimuth_rad, angles->elevation_rad)) return std::nullopt;
  view.elevation_gain = sensors::two_way_gain_with_side_lobes(
      beams.elevation, angles->elevation_rad - beams.boresight_elevation_rad);
  const glm::dvec3 direction = path_m / view.range_m;
  view.rcs_m2 = materials::rcs_m2(target.rcs, glm::transpose(target.axes) * -direction,
                                  sensor.wavelength_m());
  if (!(view.elevation_gain * view.rcs_m2 > 0.0)) return std::nullopt;
  return view;
}

std::optional<core::Echo> echo_of(const World& world, const sensors::AntennaFrame& antenna,
                                  double time_s, std::size_t index, std::uint64_t& unprojected) {
  const auto view = view_of(world.sensor, world.targets[index], antenna, time_s, unprojected);
  if (!view) return std::nullopt;
  const double range_m = view->range_m;
  core::Echo echo;
  echo.range_m = range_m;
  echo.azimuth_rad = view->angles.azimuth_rad;
  echo.elevation_rad = view->angles.elevation_rad;
  echo.object_id = static_cast<std::uint32_t>(index);
  echo.power_W =
      world.sensor.radar_constant_W_m2() * view->rcs_m2 * view->elevation_gain *
      world.attenuation.two_way_power_factor(antenna.position_m.z, view->position_m.z, range_m) /
      (range_m * range_m * range_m * range_m);
  if (world.rain_cells)
    echo.power_W *= world.rain_cells->two_way_power_factor(antenna.position_m, view->position_m);
  return echo;
}

// Adds to cells of a picture. A plain sum of n powers is good to n 1.1e-16; where that is no longer
// nothing, what each addition rounds away is kept and given back (Neumaier 1974).
class CellSums {
 public:
  CellSums(std::vector<double>& cells, std::size_t powers) : cells_(cells) {
    constexpr std::size_t kPlain = 4096;
    if (powers > kPlain) lost_.assign(cells.size(), 0.0);
  }
  ~CellSums() {
    for (std::size_t i = 0; i < lost_.size(); ++i) cells_[i] += lost_[i];
  }
  CellSums(const CellSums&) = delete;
  CellSums& operator=(const CellSums&) = delete;

  void add(int cell, double power) {
    const auto i = static_cast<std::size_t>(cell);
    const double before = cells_[i];
    cells_[i] = before + power;
    if (!lost_.empty())
      lost_[i] += before >= power ? before - cells_[i] + power : power - cells_[i] + before;
  }

 private:
  std::vector<double>& cells_;
  std::vector<double> lost_;
};

}  // namespace

TargetEchoes unobstructed_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                 double time_s) {
  TargetEchoes found;
  for (std::size_t i = 0; i < world.targets.size(); ++i)
    if (const auto echo = echo_of(world, antenna, time_s, i, found.unprojected))
      found.echoes.push_back(*echo);
  return found;
}

bool in_view(const sensors::Sensor& sensor, const PointTarget& target,
             const sensors::AntennaFrame& antenna, double time_s) {
  // A plan asks for thousands of targets in every frame, most of them out of range: no angles for
  // those.
  if (!in_gate(sensor.range, glm::distance(target.position_at(time_s), antenna.position_m)))
    return false;
  std::uint64_t unprojected = 0;
  return view_of(sensor, target, antenna, time_s, unprojected).has_value();
}

SightLines sight_lines(const World& world, const std::vector<core::Echo>& echoes, double time_s) {
  SightLines sight;
  for (const core::Echo& echo : echoes)
    sight.to_m.push_back(world.targets[echo.object_id].position_at(time_s));
  return sight;
}

std::vector<core::Echo> seen_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                    const std::vector<core::Echo>& echoes, const SightLines& sight,
                                    Multipath multipath) {
  constexpr std::size_t kAtOnce = 64;
  const std::size_t count = echoes.size();
  std::vector<std::vector<core::Echo>> found((count + kAtOnce - 1) / kAtOnce);
  core::parallel_for(found.size(), [&](std::size_t block) {
    for (std::size_t i = block * kAtOnce; i < std::min((block + 1) * kAtOnce, count); ++i)
      if (sight.clear[i] != 0)
        add_with_ground(world, antenna, sight.to_m[i], echoes[i], multipath, found[block]);
  });
  std::vector<core::Echo> seen;
  for (const std::vector<core::Echo>& block : found)
    seen.insert(seen.end(), block.begin(), block.end());
  return seen;
}

std::vector<core::Echo> point_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                     double time_s, Multipath multipath) {
  const std::vector<core::Echo> echoes = unobstructed_echoes(world, antenna, time_s).echoes;
  SightLines sight = sight_lines(world, echoes, time_s);
  sight.clear.assign(sight.to_m.size(), kAskRays);
  look_along_rays(world.surfaces(), antenna.position_m, sight);
  return seen_echoes(world, antenna, echoes, sight, multipath);
}

void add_echoes(const std::vector<core::Echo>& echoes, const sensors::Sensor& sensor,
                std::vector<double>& bscope_W, std::vector<double>& cscope_W_m3) {
  const int columns = sensor.scan.columns;
  CellSums bscope(bscope_W, echoes.size()), cscope(cscope_W_m3, echoes.size());
  for (const core::Echo& echo : echoes) {
    const int row = cscope_W_m3.empty() ? sensors::kOutside
                                        : sensors::cscope_row(sensor.display, echo.elevation_rad);
    share_echo(echo, sensor, [&](int cell, int column, double power_W) {
      bscope.add(cell * columns + column, power_W);
      if (row != sensors::kOutside)
        cscope.add(row * columns + column, power_W * echo.range_m * echo.range_m * echo.range_m);
    });
  }
}

}  // namespace fanbeam::renderer
