#include "renderer/stages/frame_echoes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/constants.h"
#include "core/errors.h"
#include "core/number_range.h"
#include "core/parallel.h"
#include "core/random.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/frame_path_loss.h"
#include "renderer/casting/ray_line.h"
#include "renderer/stages/fluctuation.h"
#include "renderer/stages/point_targets.h"

namespace fanbeam::renderer {
namespace {

// Cells of the random numbers of targets, far above those of any fan.
constexpr std::uint64_t kTargetCells = std::uint64_t{1} << 40;

void check(const FrameEchoSettings& settings) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(settings.own_velocity_mps[axis]))
      core::throw_input_error(core::ErrorClass::nonfinite, "own velocity",
                              settings.own_velocity_mps[axis], "finite components");
  core::require_range("passes", settings.passes, {1.0, 64.0});
  core::require_range("half fan", settings.half_fan_rad, {0.0, core::kPi}, "rad");
}

// The sub-columns of a frame, as those of the picture where they overlap.
struct Columns {
  double first_rad = 0.0, step_rad = 0.0;
  int count = 0;

  SubColumn at(int column) const {
    const double centre_rad = first_rad + (column + 0.5) * step_rad;
    return {centre_rad, std::cos(centre_rad), std::sin(centre_rad), step_rad};
  }
};

Columns columns_of(const sensors::Sensor& sensor, const FrameEchoSettings& settings) {
  const double step_rad = sensor.scan.column_width_rad() / settings.sampling.sub_columns;
  const double reach_rad =
      std::min(core::kPi, sensor.scan.field_of_view_rad / 2 + sensor.antenna.azimuth.cut_rad);
  const double half_rad = settings.half_fan_rad > 0.0 ? settings.half_fan_rad : reach_rad;
  const int half = std::max(1, static_cast<int>(std::ceil(half_rad / step_rad - 1e-9)));
  return {-half * step_rad, step_rad, 2 * half};
}

void check_work(const sensors::Sensor& sensor, const FrameEchoSettings& settings,
                const sensors::AntennaFrame& antenna, int columns) {
  // Columns of an antenna that is tilted may meet every range twice (elevation_fan.h).
  const double ways = azimuths_are_upright(antenna, sensor.scan.surface) ? 1.0 : 2.0;
  const double rays =
      ways * settings.sampling.rays_per_cell * sensor.range.cells * columns * settings.passes;
  if (!(rays <= kMostFrameEchoRays))
    core::throw_input_error(core::ErrorClass::limit, "rays of a frame", rays,
                            "at most 2e7: fewer rays per cell, or fewer azimuths");
}

struct Scatterers {
  std::vector<core::Echo> echoes;
  std::vector<double> phase_rad;
  std::uint64_t rays = 0;
};

class SurfaceCaster {
 public:
  SurfaceCaster(const World& world, const sensors::AntennaFrame& antenna,
                const FrameEchoSettings& settings, std::uint64_t frame_index)
      : world_(world),
        antenna_(antenna),
        settings_(settings),
        key_{seed_of_look(settings.seed, settings.look), core::kStreamFrameEcho, frame_index},
        fan_(world, settings.sampling),
        elevation_gain_(world.sensor.antenna.elevation),
        path_loss_(FramePathLoss(world).from(antenna.position_m.z)) {}

  // `number` names the column's random draws.
  Scatterers cast(const SubColumn& column, int number) const {
    Scatterers found;
    std::vector<double> edges;
    fan_.place(antenna_, column.centre_rad, column.centre_rad, edges);
    if (edges.size() < 2) return found;
    const int total = (static_cast<int>(edges.size()) - 1) * settings_.passes;
    Draw draws[kBatchRays];
    const auto aim = [&](int ray) {
      return place(edges, column, number, ray, draws[ray % kBatchRays]);
    };
    const auto look = [&](int ray, const RayBatch& batch, const RayChain& chain, int lane) {
      keep(batch, chain, lane, draws[ray % kBatchRays], found);
    };
    RayLine(world_, antenna_, elevation_gain_, path_loss_).cast(total, aim, look);
    found.rays = static_cast<std::uint64_t>(total);
    return found;
  }

 private:
  struct Draw {
    double solid_rad2 = 0.0;  // that the ray stands for
    double phase_rad = 0.0;
  };

  RayPlace place(const std::vector<double>& edges, const SubColumn& column, int number, int ray,
                 Draw& draw) const {
    const auto row = static_cast<std::size_t>(ray / settings_.passes);
    const auto pass = static_cast<std::uint64_t>(ray % settings_.passes);
    const std::uint64_t cell = static_cast<std::uint64_t>(number) * 64 + pass;
    const auto words = core::random_words(key_, cell, static_cast<std::uint32_t>(row));
    const double height_rad = edges[row + 1] - edges[row];
    draw = {height_rad * column.step_rad / settings_.passes,
            2.0 * core::kPi * core::uniform_from(words[2])};
    return {column, edges[row] + core::uniform_from(words[1]) * height_rad,
            core::uniform_from(words[0])};
  }

  void keep(const RayBatch& batch, const RayChain& chain, int lane, const Draw& draw,
            Scatterers& found) const {
    const auto i = static_cast<std::size_t>(lane);
    if (!(chain.density_W_per_rad2[i] > 0.0F)) return;
    const sensors::RangeGate& gate = world_.sensor.range;
    core::Echo echo;
    echo.range_m = static_cast<double>(chain.range_m[i]);
    if (!(echo.range_m > 0.0) || echo.range_m < gate.minimum_m || echo.range_m >= gate.maximum_m())
      return;
    const glm::dvec3 direction = glm::normalize(
        glm::dvec3(batch.direction_x[lane], batch.direction_y[lane], batch.direction_z[lane]));
    const auto angles = sensors::angles(antenna_, direction, world_.sensor);
    if (!angles) return;
    const glm::dvec3 hit_m = antenna_.position_m + echo.range_m * direction;
    echo.azimuth_rad = angles->azimuth_rad;
    echo.elevation_rad = angles->elevation_rad;
    echo.radial_speed_mps = -glm::dot(direction, settings_.own_velocity_mps);
    echo.power_W = static_cast<double>(chain.density_W_per_rad2[i]) * draw.solid_rad2;
    if (world_.rain_cells)
      echo.power_W *= world_.rain_cells->two_way_power_factor(antenna_.position_m, hit_m);
    echo.material_id =
        world_.surfaces().material(batch.geometry[lane], batch.primitive[lane], hit_m.x, hit_m.y);
    echo.object_id = batch.geometry[lane];
    found.echoes.push_back(echo);
    found.phase_rad.push_back(draw.phase_rad);
  }

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  const FrameEchoSettings& settings_;
  core::RandomKey key_;
  ElevationFan fan_;
  sensors::TwoWayTable elevation_gain_;
  PathLossTable path_loss_;
};

void add_targets(const World& world, const sensors::AntennaFrame& antenna, const FramePose& pose,
                 const FrameEchoSettings& settings, FrameEchoes& result) {
  const Fluctuation fluctuation{false, settings.swerling, 1, settings.seed, pose.frame_index};
  const core::RandomKey key{seed_of_look(settings.seed, settings.look), core::kStreamFrameEcho,
                            pose.frame_index};
  for (core::Echo echo : point_echoes(world, antenna, pose.time_s, settings.multipath)) {
    const PointTarget& target = world.targets[echo.object_id];
    const glm::dvec3 line_m = target.position_at(pose.time_s) - antenna.position_m;
    echo.radial_speed_mps = glm::dot(glm::normalize(line_m),
                                     target.velocity_at(pose.time_s) - settings.own_velocity_mps);
    if (settings.swerling)
      echo.power_W *= target_factor(target.swerling, fluctuation, echo.object_id, 0, settings.look);
    // All echoes of a target by way of the ground share its phase.
    const auto words = core::random_words(key, kTargetCells + echo.object_id, 0);
    result.echoes.push_back(echo);
    result.phase_rad.push_back(2.0 * core::kPi * core::uniform_from(words[2]));
  }
}

}  // namespace

FrameEchoes frame_echoes(const World& world, const FramePose& pose,
                         const FrameEchoSettings& settings) {
  check(settings);
  check(pose);
  const sensors::AntennaFrame antenna = antenna_of(world.sensor, pose);
  const Columns columns = columns_of(world.sensor, settings);
  check_work(world.sensor, settings, antenna, columns.count);
  if (world.surfaces().in_ground(antenna.position_m)) {
    FrameEchoes nothing;
    nothing.events.emplace_back("below_terrain");
    return nothing;
  }
  const SurfaceCaster caster(world, antenna, settings, pose.frame_index);
  std::vector<Scatterers> found(static_cast<std::size_t>(columns.count));
  core::parallel_for(found.size(), [&](std::size_t i) {
    const int number = static_cast<int>(i);
    found[i] = caster.cast(columns.at(number), number);
  });
  FrameEchoes result;
  for (const Scatterers& column : found) {
    result.echoes.insert(result.echoes.end(), column.echoes.begin(), column.echoes.end());
    result.phase_rad.insert(result.phase_rad.end(), column.phase_rad.begin(),
                            column.phase_rad.end());
    result.rays += column.rays;
  }
  result.first_target = result.echoes.size();
  add_targets(world, antenna, pose, settings, result);
  return result;
}

}  // namespace fanbeam::renderer
