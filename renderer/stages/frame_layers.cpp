#include "renderer/stages/frame_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/ray_line.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// What neighbours on one surface step over is theirs up to here, and where their facets agree that it
// is one slope: behind a crest the next visible ground is farther than they say.
constexpr int kLargestGap_cells = 4;
constexpr double kMostOfSlope = 1.5;
constexpr int kFanColumns = 2;    // that share a fan
constexpr int kBlockColumns = 8;  // of one task

// One ray that met something.
struct Seen {
  float range_m = 0.0F, elevation_rad = 0.0F, sin_grazing = 0.0F, nrcs = 0.0F;
  float range_slope = 0.0F;  // ray_chain.h
  float power_W = 0.0F;      // at full azimuth gain
  std::uint32_t surface = terrain::kNoHit;
  terrain::MaterialId material = kNoMaterial;
  terrain::ObjectId object = terrain::kTerrainObject;
};

// Between two rays that met one surface; of the nearer one what has no middle. Ranges of a plane are
// linear in their inverse.
Seen between(const Seen& a, const Seen& b, float share) {
  const auto mix = [share](float x, float y) { return x + share * (y - x); };
  Seen seen = share < 0.5F ? a : b;
  seen.range_m = 1.0F / mix(1.0F / a.range_m, 1.0F / b.range_m);
  seen.elevation_rad = mix(a.elevation_rad, b.elevation_rad);
  seen.sin_grazing = mix(a.sin_grazing, b.sin_grazing);
  seen.nrcs = mix(a.nrcs, b.nrcs);
  seen.power_W = mix(a.power_W, b.power_W);
  return seen;
}

// The sums of a column's cells, over one of the two axes.
class ColumnCells {
 public:
  void clear(int cells) { cells_.assign(static_cast<std::size_t>(cells), Cell{}); }

  void add(int index, int azimuth, const Seen& seen) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    // What sends nothing counts where nothing else is seen.
    const double weight = static_cast<double>(seen.power_W) + 1e-60;
    cell.weight += weight;
    cell.range_m += weight * static_cast<double>(seen.range_m);
    cell.sin_grazing += weight * static_cast<double>(seen.sin_grazing);
    cell.nrcs += weight * static_cast<double>(seen.nrcs);
    if (cell.last_azimuth != azimuth) {
      cell.last_azimuth = azimuth;
      ++cell.azimuths;
    }
    if (!cell.any || seen.power_W > cell.strongest.power_W) cell.strongest = seen;
    cell.any = true;
  }

  void add_target(int index, const Seen& target) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    if (!cell.any || target.power_W > cell.strongest.power_W) cell.strongest = target;
    cell.any = true;
  }

  void write(int column, int columns, LayerSet& set) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Cell& cell = cells_[i];
      if (!cell.any) continue;
      const std::size_t to =
          i * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
      set.visibility[to] = static_cast<float>(cell.azimuths) / kLayerAzimuths;
      set.material[to] = cell.strongest.material;
      set.object[to] = cell.strongest.object;
      set.elevation_rad[to] = cell.strongest.elevation_rad;
      if (cell.azimuths == 0) continue;
      set.range_m[to] = static_cast<float>(cell.range_m / cell.weight);
      set.grazing_rad[to] =
          static_cast<float>(std::asin(std::min(cell.sin_grazing / cell.weight, 1.0)));
      set.nrcs[to] = static_cast<float>(cell.nrcs / cell.weight);
    }
  }

 private:
  struct Cell {
    double weight = 0.0, range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;
    int azimuths = 0, last_azimuth = -1;
    bool any = false;
    Seen strongest;
  };
  std::vector<Cell> cells_;
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
        // Steps of metres will do where losses weigh a cell's parts against each other.
        path_loss_(world.attenuation, antenna.position_m.z,
                   antenna.position_m.z - world.sensor.range.maximum_m(),
                   antenna.position_m.z + world.sensor.range.maximum_m()),
        beam_rad_(azimuth_width_rad(world.sensor)),
        row_rad_(cscope_row_rad(world.sensor.display)) {}

  // Columns [first, last), which share a fan in pairs.
  void cast(int first, int last, const std::vector<std::vector<core::Echo>>& targets,
            FrameLayers& layers) const {
    thread_local std::vector<double> edges;
    RayLine rays(world_, antenna_, elevation_gain_, path_loss_);
    const sensors::Scan& scan = world_.sensor.scan;
    for (int column = first; column < last; column += kFanColumns) {
      const int abreast = std::min(kFanColumns, last - column);
      fan_.place(antenna_, sensors::column_edge_rad(scan, column),
                 sensors::column_edge_rad(scan, column + abreast), edges);
      look(column, abreast, edges, rays);
      for (int i = 0; i < abreast; ++i)
        fill_column(column + i, edges.size() >= 2 ? i * kLayerAzimuths : kNoLines,
                    targets[static_cast<std::size_t>(column + i)], layers);
    }
  }

 private:
  static Sampling layer_sampling() {
    Sampling sampling;
    sampling.rays_per_cell = 0.5;
    return sampling;
  }

  using Line = std::vector<Seen>;
  static constexpr int kLines = kFanColumns * kLayerAzimuths;
  static constexpr int kNoLines = -1;
  // Of the columns that share a fan, from the left.
  static std::array<Line, kLines>& lines() {
    thread_local std::array<Line, kLines> of_thread;
    return of_thread;
  }

  // From the lines that begin with `first`.
  void fill_column(int column, int first, const std::vector<core::Echo>& targets,
                   FrameLayers& layers) const {
    thread_local ColumnCells ranges, rows;
    const sensors::Sensor& sensor = world_.sensor;
    ranges.clear(sensor.range.cells);
    rows.clear(with_cscope_ ? sensor.display.cscope_rows : 0);
    for (int k = 0; k < kLayerAzimuths && first != kNoLines; ++k)
      deposit(lines()[static_cast<std::size_t>(first + k)], k, ranges, rows);
    for (const core::Echo& echo : targets) add(echo, ranges, rows);
    ranges.write(column, sensor.scan.columns, layers.bscope);
    if (with_cscope_) rows.write(column, sensor.scan.columns, layers.cscope);
  }

  // Rays of all azimuths of some columns, from the lowest up.
  void look(int column, int columns, const std::vector<double>& edges, RayLine& rays) const {
    const sensors::Scan& scan = world_.sensor.scan;
    const double step_rad = scan.column_width_rad() / kLayerAzimuths;
    const int total = std::max(static_cast<int>(edges.size()) - 1, 0);
    std::array<SubColumn, kLines> azimuths;
    std::array<double, kLines> share;
    const int first = column * kLayerAzimuths, count = columns * kLayerAzimuths;
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double azimuth_rad = sensors::column_middle_rad(scan, column + i / kLayerAzimuths) +
                                 (i % kLayerAzimuths + 0.5 - 0.5 * kLayerAzimuths) * step_rad;
      azimuths[at] = {azimuth_rad, std::cos(azimuth_rad), std::sin(azimuth_rad), step_rad};
      share[at] = elevation_place(first + i, 0.5);
      lines()[at].resize(static_cast<std::size_t>(total));
    }
    const auto aim = [&](int ray, int i) {
      const auto row = static_cast<std::size_t>(ray);
      return RayPlace{
          edges[row] + share[static_cast<std::size_t>(i)] * (edges[row + 1] - edges[row]),
          dither(static_cast<std::uint32_t>(ray), first + i, 0)};
    };
    std::array<Line, kLines>& seen_by = lines();
    const auto keep = [&](int ray, int i, const RayBatch& batch, const RayChain& chain, int lane) {
      const auto row = static_cast<std::size_t>(ray);
      seen_by[static_cast<std::size_t>(i)][row] =
          seen(batch, chain, lane, edges[row + 1] - edges[row]);
    };
    rays.cast({azimuths.data(), static_cast<std::size_t>(count)}, total, aim, keep);
  }

  Seen seen(const RayBatch& batch, const RayChain& chain, int lane, double height_rad) const {
    Seen result;
    const auto i = static_cast<std::size_t>(lane);
    if (batch.geometry[lane] == terrain::kNoHit) return result;
    result.surface = chain.surface[i];
    result.range_m = chain.range_m[i];
    result.range_slope = chain.range_slope[i];
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

  // Range cells that two neighbours on one surface stepped over.
  void fill_ranges(const Seen& a, int from, const Seen& b, int to, int azimuth,
                   ColumnCells& ranges) const {
    const int gap = std::abs(to - from);
    if (a.surface != b.surface || gap < 2 || gap > kLargestGap_cells) return;
    const double step_rad =
        static_cast<double>(b.elevation_rad) - static_cast<double>(a.elevation_rad);
    const auto told_m = [step_rad](const Seen& seen) {
      return std::abs(static_cast<double>(seen.range_m) * static_cast<double>(seen.range_slope) *
                      step_rad);
    };
    const double apart_m =
        std::abs(static_cast<double>(b.range_m) - static_cast<double>(a.range_m));
    if (apart_m > kMostOfSlope * std::max(told_m(a), told_m(b)) + world_.sensor.range.cell_m)
      return;
    for (int step = 1; step < gap; ++step)
      ranges.add(from + (to > from ? step : -step), azimuth,
                 between(a, b, static_cast<float>(step) / static_cast<float>(gap)));
  }

  // Counts on above and below the window.
  int row_of(const Seen& seen) const {
    const sensors::Display& display = world_.sensor.display;
    return static_cast<int>(
        std::floor((display.cscope_top_rad - static_cast<double>(seen.elevation_rad)) / row_rad_));
  }

  // Rows between two neighbours: what they both meet, or each its half.
  void fill_rows(const Seen& a, int from, const Seen& b, int to, int azimuth,
                 ColumnCells& rows) const {
    const int last = world_.sensor.display.cscope_rows - 1;
    for (int row = std::max(std::min(from, to) + 1, 0);
         row <= std::min(std::max(from, to) - 1, last); ++row) {
      const float share = static_cast<float>(row - from) / static_cast<float>(to - from);
      rows.add(row, azimuth,
               a.surface == b.surface ? between(a, b, share) : (share < 0.5F ? a : b));
    }
  }

  void deposit(const std::vector<Seen>& line, int azimuth, ColumnCells& ranges,
               ColumnCells& rows) const {
    const sensors::Sensor& sensor = world_.sensor;
    int last_cell = sensors::kOutside, last_row = 0;
    const Seen* last = nullptr;
    for (const Seen& now : line) {
      if (now.surface == terrain::kNoHit) {
        last = nullptr;
        continue;
      }
      if (with_cscope_) {
        const int row = row_of(now);
        if (row >= 0 && row < sensor.display.cscope_rows) rows.add(row, azimuth, now);
        if (last != nullptr) fill_rows(*last, last_row, now, row, azimuth, rows);
        last_row = row;
      }
      const int cell = sensors::range_row(sensor.range, static_cast<double>(now.range_m));
      if (cell != sensors::kOutside) {
        ranges.add(cell, azimuth, now);
        if (last != nullptr && last_cell != sensors::kOutside)
          fill_ranges(*last, last_cell, now, cell, azimuth, ranges);
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
  double beam_rad_, row_rad_;
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
  // Neighbours by one thread: their cells lie side by side.
  const int blocks = (sensor.scan.columns + kBlockColumns - 1) / kBlockColumns;
  core::parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t block) {
    const int first = static_cast<int>(block) * kBlockColumns;
    const int last = std::min(first + kBlockColumns, sensor.scan.columns);
    caster.cast(first, last, of_column, layers);
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
