#include "renderer/stages/frame_layers.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/casting/echo_density.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/frame_path_loss.h"
#include "renderer/casting/packet_sender.h"
#include "renderer/casting/ray_aim.h"
#include "renderer/casting/ray_batch.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

constexpr int kLargestGap_cells = 4;

// One ray that met something.
struct Seen {
  float range_m = 0.0F, elevation_rad = 0.0F, sin_grazing = 0.0F, nrcs = 0.0F;
  float power_W = 0.0F;  // at full azimuth gain
  std::uint32_t surface = terrain::kNoHit;
  terrain::MaterialId material = kNoMaterial;
  terrain::ObjectId object = terrain::kTerrainObject;
};

// The sums of a column's cells, over one of the two axes.
class ColumnCells {
 public:
  void clear(int cells) {
    const auto count = static_cast<std::size_t>(cells);
    weight_.assign(count, 0.0F);
    range_m_.assign(count, 0.0F);
    sin_grazing_.assign(count, 0.0F);
    nrcs_.assign(count, 0.0F);
    azimuths_.assign(count, 0);
    last_azimuth_.assign(count, -1);
    strongest_.assign(count, Seen{});
  }

  void add(int cell, int azimuth, const Seen& seen) {
    const auto i = static_cast<std::size_t>(cell);
    weight_[i] += seen.power_W;
    range_m_[i] += seen.power_W * seen.range_m;
    sin_grazing_[i] += seen.power_W * seen.sin_grazing;
    nrcs_[i] += seen.power_W * seen.nrcs;
    if (last_azimuth_[i] != azimuth) {
      last_azimuth_[i] = azimuth;
      ++azimuths_[i];
    }
    if (seen.power_W > strongest_[i].power_W) strongest_[i] = seen;
  }

  void add_target(int cell, const Seen& target) {
    Seen& strongest = strongest_[static_cast<std::size_t>(cell)];
    if (target.power_W > strongest.power_W) strongest = target;
  }

  void write(int column, int columns, LayerSet& set) const {
    for (std::size_t i = 0; i < weight_.size(); ++i) {
      if (azimuths_[i] == 0 && !(strongest_[i].power_W > 0.0F)) continue;
      const std::size_t to =
          i * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
      set.visibility[to] = static_cast<float>(azimuths_[i]) / kLayerAzimuths;
      set.material[to] = strongest_[i].material;
      set.object[to] = strongest_[i].object;
      set.elevation_rad[to] = strongest_[i].elevation_rad;
      if (!(weight_[i] > 0.0F)) continue;
      set.range_m[to] = range_m_[i] / weight_[i];
      set.grazing_rad[to] = std::asin(std::min(sin_grazing_[i] / weight_[i], 1.0F));
      set.nrcs[to] = nrcs_[i] / weight_[i];
    }
  }

 private:
  std::vector<float> weight_, range_m_, sin_grazing_, nrcs_;
  std::vector<int> azimuths_, last_azimuth_;
  std::vector<Seen> strongest_;
};

// Echoes of targets by column.
std::vector<std::vector<core::Echo>> by_column(const std::vector<core::Echo>& echoes,
                                               const sensors::Scan& scan) {
  std::vector<std::vector<core::Echo>> columns(static_cast<std::size_t>(scan.columns));
  for (const core::Echo& echo : echoes) {
    const int column = sensors::azimuth_column(scan, echo.azimuth_rad);
    if (column != sensors::kOutside) columns[static_cast<std::size_t>(column)].push_back(echo);
  }
  return columns;
}

LayerSet empty_set(int rows, int columns) {
  const auto cells = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  LayerSet set;
  for (std::vector<float>* layer : {&set.visibility, &set.range_m, &set.grazing_rad, &set.nrcs,
                                    &set.elevation_rad, &set.double_bounce})
    layer->assign(cells, 0.0F);
  set.material.assign(cells, kNoMaterial);
  set.object.assign(cells, terrain::kTerrainObject);
  return set;
}

class LayerCaster {
 public:
  LayerCaster(const World& world, const sensors::AntennaFrame& antenna, bool with_cscope)
      : world_(world),
        antenna_(antenna),
        with_cscope_(with_cscope),
        fan_(world, layer_sampling()),
        elevation_gain_(world.sensor.antenna.elevation),
        path_loss_(FramePathLoss(world).from(antenna.position_m.z)),
        beam_rad_(azimuth_width_rad(world.sensor)) {}

  template <int N>
  void cast(int column, const std::vector<core::Echo>& targets, FrameLayers& layers) const {
    thread_local ColumnCells ranges, rows;
    thread_local std::vector<double> edges;
    thread_local std::vector<Seen> line;
    const sensors::Sensor& sensor = world_.sensor;
    ranges.clear(sensor.range.cells);
    rows.clear(with_cscope_ ? sensor.display.cscope_rows : 0);
    const double middle_rad = sensors::column_middle_rad(sensor.scan, column);
    const double step_rad = sensor.scan.column_width_rad() / kLayerAzimuths;
    fan_.place(antenna_, middle_rad - step_rad, middle_rad + step_rad, edges);
    for (int k = 0; k < kLayerAzimuths && edges.size() >= 2; ++k) {
      const double azimuth_rad = middle_rad + (k + 0.5 - 0.5 * kLayerAzimuths) * step_rad;
      look<N>({azimuth_rad, std::cos(azimuth_rad), std::sin(azimuth_rad), step_rad},
              column * kLayerAzimuths + k, edges, line);
      deposit(line, k, ranges, rows);
    }
    for (const core::Echo& echo : targets) add(echo, ranges, rows);
    ranges.write(column, sensor.scan.columns, layers.bscope);
    if (with_cscope_) rows.write(column, sensor.scan.columns, layers.cscope);
  }

 private:
  static Sampling layer_sampling() {
    Sampling sampling;
    sampling.rays_per_cell = 0.5;
    return sampling;
  }

  // Rays of one azimuth, from the lowest up.
  template <int N>
  void look(const SubColumn& column, int number, const std::vector<double>& edges,
            std::vector<Seen>& line) const {
    const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
    const RayAim aim(antenna_, cone, azimuths_are_upright(antenna_, world_.sensor.scan.surface));
    PacketSender<N> sender(world_.surfaces(), world_.sensor.range, antenna_.position_m, nullptr);
    const EchoDensity density(world_, path_loss_, antenna_.position_m);
    thread_local RayBatch batch;
    thread_local RayChain chain;
    for (int lane = 0; lane < kBatchRays; ++lane) batch.set_column(lane, column);
    const int total = static_cast<int>(edges.size()) - 1;
    const double place = elevation_place(number, 0.5);
    line.resize(static_cast<std::size_t>(total));
    for (int done = 0; done < total; done += kBatchRays) {
      const int count = std::min(kBatchRays, total - done);
      for (int lane = 0; lane < count; ++lane) {
        const auto row = static_cast<std::size_t>(done + lane);
        const double e_rad = edges[row] + place * (edges[row + 1] - edges[row]);
        batch.elevation_rad[lane] = e_rad;
        batch.gain[lane] = elevation_gain_(e_rad - world_.sensor.antenna.boresight_elevation_rad);
        batch.offset_rad[lane] =
            column.offset_rad(dither(static_cast<std::uint32_t>(row), number, 0));
      }
      batch.close(count);
      aim.point(batch);
      sender.cast(batch);
      chain.clear();
      chain.append(kBatchRays);
      density.shade(batch, 0, chain);
      for (int lane = 0; lane < count; ++lane) {
        const auto row = static_cast<std::size_t>(done + lane);
        line[row] = seen(batch, chain, lane, edges[row + 1] - edges[row]);
      }
    }
  }

  Seen seen(const RayBatch& batch, const RayChain& chain, int lane, double height_rad) const {
    Seen result;
    const auto i = static_cast<std::size_t>(lane);
    if (batch.geometry[lane] == terrain::kNoHit) return result;
    result.surface = chain.surface[i];
    result.range_m = chain.range_m[i];
    result.elevation_rad = static_cast<float>(batch.elevation_rad[lane]);
    result.power_W = static_cast<float>(static_cast<double>(chain.density_W_per_rad2[i]) *
                                        height_rad * beam_rad_ / kLayerAzimuths);
    const double dx = static_cast<double>(batch.direction_x[lane]);
    const double dy = static_cast<double>(batch.direction_y[lane]);
    const double dz = static_cast<double>(batch.direction_z[lane]);
    const double nx = static_cast<double>(batch.normal_x[lane]);
    const double ny = static_cast<double>(batch.normal_y[lane]);
    const double nz = static_cast<double>(batch.normal_z[lane]);
    const double sine =
        std::clamp(-(nx * dx + ny * dy + nz * dz) /
                       std::sqrt((nx * nx + ny * ny + nz * nz) * (dx * dx + dy * dy + dz * dz)),
                   0.0, 1.0);
    const double range_m = static_cast<double>(result.range_m);
    const double x_m = antenna_.position_m.x + range_m * dx;
    const double y_m = antenna_.position_m.y + range_m * dy;
    const terrain::RayScene& surfaces = world_.surfaces();
    result.material = surfaces.material(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
    result.object = surfaces.object(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
    result.sin_grazing = static_cast<float>(sine);
    result.nrcs =
        static_cast<float>(world_.nrcs.tables()[result.material].sigma0_over_sine(sine) * sine);
    return result;
  }

  void add(const core::Echo& echo, ColumnCells& ranges, ColumnCells& rows) const {
    Seen target;
    target.elevation_rad = static_cast<float>(echo.elevation_rad);
    target.power_W = static_cast<float>(echo.power_W);
    target.object =
        static_cast<terrain::ObjectId>(world_.geometry->object_names.size()) + echo.object_id;
    const int cell = sensors::range_row(world_.sensor.range, echo.range_m);
    if (cell != sensors::kOutside) ranges.add_target(cell, target);
    const int row = with_cscope_ ? sensors::cscope_row(world_.sensor.display, echo.elevation_rad)
                                 : sensors::kOutside;
    if (row != sensors::kOutside) rows.add_target(row, target);
  }

  // Cells that two neighbours on one surface stepped over.
  static void fill(const Seen& a, int from, const Seen& b, int to, int azimuth,
                   ColumnCells& ranges) {
    const int gap = std::abs(to - from);
    if (gap < 2 || gap > kLargestGap_cells) return;
    for (int step = 1; step < gap; ++step) {
      const float share = static_cast<float>(step) / static_cast<float>(gap);
      const auto between = [share](float x, float y) { return x + share * (y - x); };
      Seen seen = share < 0.5F ? a : b;
      seen.range_m = between(a.range_m, b.range_m);
      seen.elevation_rad = between(a.elevation_rad, b.elevation_rad);
      seen.sin_grazing = between(a.sin_grazing, b.sin_grazing);
      seen.nrcs = between(a.nrcs, b.nrcs);
      seen.power_W = between(a.power_W, b.power_W);
      ranges.add(from + (to > from ? step : -step), azimuth, seen);
    }
  }

  void deposit(const std::vector<Seen>& line, int azimuth, ColumnCells& ranges,
               ColumnCells& rows) const {
    const sensors::Sensor& sensor = world_.sensor;
    int last_cell = sensors::kOutside;
    const Seen* last = nullptr;
    for (const Seen& now : line) {
      if (now.surface == terrain::kNoHit) {
        last = nullptr;
        continue;
      }
      if (with_cscope_) {
        const int row = sensors::cscope_row(sensor.display, static_cast<double>(now.elevation_rad));
        if (row != sensors::kOutside) rows.add(row, azimuth, now);
      }
      const int cell = sensors::range_row(sensor.range, static_cast<double>(now.range_m));
      if (cell != sensors::kOutside) {
        ranges.add(cell, azimuth, now);
        if (last != nullptr && last->surface == now.surface && last_cell != sensors::kOutside)
          fill(*last, last_cell, now, cell, azimuth, ranges);
      }
      last = &now;
      last_cell = cell;
    }
  }

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  bool with_cscope_;
  ElevationFan fan_;
  sensors::TwoWayTable elevation_gain_;
  PathLossTable path_loss_;
  double beam_rad_;
};

}  // namespace

FrameLayers empty_layers(const sensors::Sensor& sensor, bool with_cscope) {
  FrameLayers layers{empty_set(sensor.range.cells, sensor.scan.columns), {}};
  if (with_cscope) layers.cscope = empty_set(sensor.display.cscope_rows, sensor.scan.columns);
  return layers;
}

FrameLayers frame_layers(const World& world, const sensors::AntennaFrame& antenna,
                         const std::vector<core::Echo>& targets, bool with_cscope) {
  const sensors::Sensor& sensor = world.sensor;
  FrameLayers layers = empty_layers(sensor, with_cscope);
  const std::vector<std::vector<core::Echo>> of_column = by_column(targets, sensor.scan);
  const LayerCaster caster(world, antenna, with_cscope);
  const bool wide = world.surfaces().native_packet() == 16;
  core::parallel_for(static_cast<std::size_t>(sensor.scan.columns), [&](std::size_t column) {
    if (wide)
      caster.cast<16>(static_cast<int>(column), of_column[column], layers);
    else
      caster.cast<8>(static_cast<int>(column), of_column[column], layers);
  });
  return layers;
}

std::vector<float> added_share(const std::vector<double>& direct,
                               const std::vector<double>& total) {
  std::vector<float> share(total.size(), 0.0F);
  for (std::size_t i = 0; i < total.size(); ++i)
    if (total[i] > 0.0)
      share[i] = static_cast<float>(std::clamp((total[i] - direct[i]) / total[i], 0.0, 1.0));
  return share;
}

}  // namespace fanbeam::renderer
