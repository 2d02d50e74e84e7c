#include "renderer/stages/frame_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/parallel.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/ray_line.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/layer_cells.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// What neighbours on one surface step over is theirs up to here, and where their facets agree that it
// is one slope: behind a crest the next visible ground is farther than they say.
constexpr int kLargestGap_cells = 8;
constexpr double kMostOfSlope = 1.5;
constexpr int kFanColumns = 2;    // that share a fan
constexpr int kBlockColumns = 8;  // of one task

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

// `own`: the layer that this scope alone has.
LayerSet empty_set(int rows, int columns, std::vector<float> LayerSet::*own) {
  const auto cells = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  LayerSet set;
  for (std::vector<float>* layer : {&set.visibility, &set.grazing_rad, &set.nrcs, &(set.*own)})
    layer->assign(cells, 0.0F);
  set.material.assign(cells, kNoMaterial);
  set.object.assign(cells, terrain::kTerrainObject);
  return set;
}

// Without the double bounce.
FrameLayers unseen(const sensors::Sensor& sensor, bool with_cscope) {
  FrameLayers layers{empty_set(sensor.range.cells, sensor.scan.columns, &LayerSet::elevation_rad),
                     {}};
  if (with_cscope)
    layers.cscope = empty_set(sensor.display.cscope_rows, sensor.scan.columns, &LayerSet::range_m);
  return layers;
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
    sampling.rays_per_cell = 0.25;
    sampling.largest_step_rad *= 2.0;
    sampling.largest_step_rows = 2.0;
    return sampling;
  }

  using Line = std::vector<LayerHit>;
  static constexpr int kLines = kFanColumns * kLayerAzimuths;
  static constexpr int kNoLines = -1;
  // Of the columns that share a fan, from the left: rays of all azimuths side by side.
  struct Lines {
    std::array<SubColumn, kLines> azimuths;
    int count = 0, first = 0;  // azimuths; the number of the first one
    std::array<Line, kLines> hits, middles;
    std::vector<std::size_t> gaps;  // rows after which a ray is wanted

    std::size_t rows() const { return hits[0].size(); }
    std::span<const SubColumn> columns() const {
      return {azimuths.data(), static_cast<std::size_t>(count)};
    }
  };
  static Lines& lines() {
    thread_local Lines of_thread;
    return of_thread;
  }

  // From the lines that begin with `first`.
  void fill_column(int column, int first, const std::vector<core::Echo>& targets,
                   FrameLayers& layers) const {
    thread_local LayerCells ranges, rows;
    const sensors::Sensor& sensor = world_.sensor;
    ranges.clear(sensor.range.cells);
    rows.clear(with_cscope_ ? sensor.display.cscope_rows : 0);
    for (int k = 0; k < kLayerAzimuths && first != kNoLines; ++k)
      deposit(lines().hits[static_cast<std::size_t>(first + k)], k, ranges, rows);
    for (const core::Echo& echo : targets) add(echo, ranges, rows);
    ranges.write(column, sensor.scan.columns, kLayerAzimuths, layers.bscope);
    if (with_cscope_) rows.write(column, sensor.scan.columns, kLayerAzimuths, layers.cscope);
  }

  // Rays of all azimuths of some columns, from the lowest up.
  void look(int column, int columns, const std::vector<double>& edges, RayLine& rays) const {
    const sensors::Scan& scan = world_.sensor.scan;
    const double step_rad = scan.column_width_rad() / kLayerAzimuths;
    Lines& all = lines();
    std::array<double, kLines> share;
    all.first = column * kLayerAzimuths;
    all.count = columns * kLayerAzimuths;
    const std::size_t total = edges.empty() ? 0 : edges.size() - 1;
    for (int i = 0; i < all.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double azimuth_rad = sensors::column_middle_rad(scan, column + i / kLayerAzimuths) +
                                 (i % kLayerAzimuths + 0.5 - 0.5 * kLayerAzimuths) * step_rad;
      all.azimuths[at] = {azimuth_rad, std::cos(azimuth_rad), std::sin(azimuth_rad), step_rad};
      share[at] = elevation_place(all.first + i, 0.5);
      all.hits[at].resize(total);
    }
    send(all, all.hits, rays, 0, [&](std::size_t row, std::size_t i) {
      return edges[row] + share[i] * (edges[row + 1] - edges[row]);
    });
    if (total == 0) return;
    look_between(all, rays);
    for (int i = 0; i < all.count; ++i)
      share_out(edges.front(), edges.back(), all.hits[static_cast<std::size_t>(i)]);
  }

  // As many rays as `to` has rows, each at the elevation that `place` says.
  template <class Place>
  void send(const Lines& all, std::array<Line, kLines>& to, RayLine& rays, std::size_t dithered,
            const Place& place) const {
    const auto aim = [&](int ray, int i) {
      const auto row = static_cast<std::size_t>(ray);
      return RayPlace{place(row, static_cast<std::size_t>(i)),
                      dither(static_cast<std::uint32_t>(dithered + row), all.first + i, 0)};
    };
    const auto keep = [&](int ray, int i, const RayBatch& batch, const RayChain& chain, int lane) {
      see(batch, chain, lane, to[static_cast<std::size_t>(i)][static_cast<std::size_t>(ray)]);
    };
    rays.cast(all.columns(), static_cast<int>(to[0].size()), aim, keep);
  }

  // Where neighbours of some azimuth do not tell what lies between them a ray of each goes there.
  void look_between(Lines& all, RayLine& rays) const {
    const auto count = static_cast<std::size_t>(all.count);
    all.gaps.clear();
    for (std::size_t row = 0; row + 1 < all.rows(); ++row)
      for (std::size_t i = 0; i < count; ++i)
        if (untold(all.hits[i][row], all.hits[i][row + 1])) {
          all.gaps.push_back(row);
          break;
        }
    for (std::size_t i = 0; i < count; ++i) all.middles[i].resize(all.gaps.size());
    send(all, all.middles, rays, all.rows(), [&](std::size_t gap, std::size_t i) {
      const LayerHit* const below = &all.hits[i][all.gaps[gap]];
      return 0.5 * (static_cast<double>(below[0].elevation_rad) +
                    static_cast<double>(below[1].elevation_rad));
    });
    for (std::size_t i = 0; i < count; ++i) insert(all.middles[i], all.gaps, all.hits[i]);
  }

  static void insert(const Line& middles, const std::vector<std::size_t>& gaps, Line& hits) {
    std::size_t from = hits.size(), to = from + middles.size();
    hits.resize(to);
    for (std::size_t gap = gaps.size(); gap-- > 0;) {
      while (from > gaps[gap] + 1) hits[--to] = hits[--from];
      hits[--to] = middles[gap];
    }
  }

  // Each ray stands for what is nearer to it than to its neighbours.
  static void share_out(double lowest_rad, double highest_rad, Line& hits) {
    auto border_rad = static_cast<float>(lowest_rad);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const float next_rad = i + 1 < hits.size()
                                 ? 0.5F * (hits[i].elevation_rad + hits[i + 1].elevation_rad)
                                 : static_cast<float>(highest_rad);
      hits[i].height_rad = next_rad - border_rad;
      border_rad = next_rad;
    }
  }

  // Whether what lies between two neighbours may be neither's.
  bool untold(const LayerHit& a, const LayerHit& b) const {
    if (!a.hit() || !b.hit()) return a.hit() != b.hit();
    const bool cells = std::abs(a.cell - b.cell) >= 2;
    if (!cells && std::abs(a.row - b.row) < 2) return false;
    if (a.surface != b.surface) return true;
    if (!is_ground(a) && (a.material != b.material || a.object != b.object)) return true;
    return cells && !one_slope(a, b);
  }

  void see(const RayBatch& batch, const RayChain& chain, int lane, LayerHit& hit) const {
    const auto i = static_cast<std::size_t>(lane);
    hit.elevation_rad = static_cast<float>(batch.elevation_rad[lane]);
    hit.surface = terrain::kNoHit;
    if (batch.geometry[lane] == terrain::kNoHit) return;
    hit.surface = chain.surface[i];
    hit.range_m = chain.range_m[i];
    hit.range_slope = chain.range_slope[i];
    hit.power_W_per_rad = static_cast<float>(static_cast<double>(chain.density_W_per_rad2[i]) *
                                             beam_rad_ / kLayerAzimuths);
    const float dx = batch.direction_x[lane], dy = batch.direction_y[lane],
                dz = batch.direction_z[lane];
    const float nx = batch.normal_x[lane], ny = batch.normal_y[lane], nz = batch.normal_z[lane];
    hit.sin_grazing = std::clamp(
        -(nx * dx + ny * dy + nz * dz) / std::sqrt(nx * nx + ny * ny + nz * nz), 0.0F, 1.0F);
    const auto range_m = static_cast<double>(hit.range_m);
    const double x_m = antenna_.position_m.x + range_m * static_cast<double>(dx);
    const double y_m = antenna_.position_m.y + range_m * static_cast<double>(dy);
    hit.x_m = static_cast<float>(x_m);
    hit.y_m = static_cast<float>(y_m);
    const terrain::RayScene& surfaces = world_.surfaces();
    hit.material = surfaces.material(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
    hit.object = surfaces.object(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
    const auto sine = static_cast<double>(hit.sin_grazing);
    hit.nrcs = static_cast<float>(world_.nrcs.tables()[hit.material].sigma0_over_sine(sine) * sine);
    hit.cell = cell_of(range_m);
    hit.row = row_of(hit);
  }

  void add(const core::Echo& echo, LayerCells& ranges, LayerCells& rows) const {
    LayerHit target;
    target.elevation_rad = static_cast<float>(echo.elevation_rad);
    target.height_rad = 1.0F;
    target.power_W_per_rad = static_cast<float>(echo.power_W);
    target.object =
        static_cast<terrain::ObjectId>(world_.geometry->object_names.size()) + echo.object_id;
    const int cell = sensors::range_row(world_.sensor.range, echo.range_m);
    if (cell != sensors::kOutside) ranges.add_target(cell, target);
    const int row = with_cscope_ ? sensors::cscope_row(world_.sensor.display, echo.elevation_rad)
                                 : sensors::kOutside;
    if (row != sensors::kOutside) rows.add_target(row, target);
  }

  bool is_ground(const LayerHit& hit) const {
    const terrain::RayScene& surfaces = world_.surfaces();
    return surfaces.terrain() != nullptr &&
           (hit.surface | 1U) == surface_of(terrain::kTerrainGeometry, 1U);
  }

  // The ground has the cover and the paint of its own place.
  LayerHit on_one_surface(const LayerHit& a, const LayerHit& b, float share) const {
    LayerHit hit = between(a, b, share);
    if (!is_ground(hit)) return hit;
    const terrain::SurfaceMap& map = *world_.surfaces().surface_map();
    const auto x_m = static_cast<double>(hit.x_m), y_m = static_cast<double>(hit.y_m);
    hit.object = map.object_at(x_m, y_m);
    hit.material = map.material_at(x_m, y_m);
    if (hit.material == a.material && hit.material == b.material) return hit;
    const auto sine = static_cast<double>(hit.sin_grazing);
    const auto nrcs =
        static_cast<float>(world_.nrcs.tables()[hit.material].sigma0_over_sine(sine) * sine);
    if (hit.nrcs > 0.0F) hit.power_W_per_rad *= nrcs / hit.nrcs;
    hit.nrcs = nrcs;
    return hit;
  }

  bool in_gate(const LayerHit& hit) const {
    const auto range_m = static_cast<double>(hit.range_m);
    return range_m >= world_.sensor.range.minimum_m && range_m < world_.sensor.range.maximum_m();
  }

  // Counts on before and behind the gate.
  int cell_of(double range_m) const {
    const sensors::RangeGate& gate = world_.sensor.range;
    const int cell = sensors::range_row(gate, range_m);
    if (cell != sensors::kOutside) return cell;
    const auto beside = static_cast<int>(std::floor((range_m - gate.minimum_m) / gate.cell_m));
    return range_m < gate.minimum_m ? std::min(beside, -1) : std::max(beside, gate.cells);
  }
  bool in_gate(int cell) const { return cell >= 0 && cell < world_.sensor.range.cells; }

  // Counts on above and below the window.
  int row_of(const LayerHit& hit) const {
    const sensors::Display& display = world_.sensor.display;
    return static_cast<int>(
        std::floor((display.cscope_top_rad - static_cast<double>(hit.elevation_rad)) / row_rad_));
  }

  // Whether two neighbours on one surface own the range cells that they step over.
  bool one_slope(const LayerHit& a, const LayerHit& b) const {
    if (a.surface != b.surface || std::abs(b.cell - a.cell) > kLargestGap_cells) return false;
    const float step_rad = b.elevation_rad - a.elevation_rad;
    const float told_m = std::max(std::abs(a.range_m * a.range_slope * step_rad),
                                  std::abs(b.range_m * b.range_slope * step_rad));
    return static_cast<double>(std::abs(b.range_m - a.range_m)) <=
           kMostOfSlope * static_cast<double>(told_m) + world_.sensor.range.cell_m;
  }

  void fill_ranges(const LayerHit& a, const LayerHit& b, int azimuth, LayerCells& ranges) const {
    const int gap = std::abs(b.cell - a.cell);
    if (gap < 2 || !one_slope(a, b)) return;
    for (int cell = std::min(a.cell, b.cell) + 1; cell < std::max(a.cell, b.cell); ++cell) {
      if (!in_gate(cell)) continue;
      const auto middle_m = static_cast<float>(sensors::range_middle_m(world_.sensor.range, cell));
      const float share = b.range_m * (middle_m - a.range_m) / (middle_m * (b.range_m - a.range_m));
      ranges.add(cell, azimuth, on_one_surface(a, b, share));
    }
  }

  // Rows between two neighbours: what they both meet, or each its half.
  void fill_rows(const LayerHit& a, const LayerHit& b, int azimuth, LayerCells& rows) const {
    const int last = world_.sensor.display.cscope_rows - 1;
    for (int row = std::max(std::min(a.row, b.row) + 1, 0);
         row <= std::min(std::max(a.row, b.row) - 1, last); ++row) {
      const float share = static_cast<float>(row - a.row) / static_cast<float>(b.row - a.row);
      const LayerHit hit =
          a.surface == b.surface ? on_one_surface(a, b, share) : (share < 0.5F ? a : b);
      if (in_gate(hit)) rows.add(row, azimuth, hit);
    }
  }

  void deposit(const Line& line, int azimuth, LayerCells& ranges, LayerCells& rows) const {
    const int row_count = world_.sensor.display.cscope_rows;
    const LayerHit* last = nullptr;
    for (const LayerHit& now : line) {
      if (!now.hit()) {
        last = nullptr;
        continue;
      }
      const bool shown = in_gate(now.cell);
      if (with_cscope_) {
        if (shown && now.row >= 0 && now.row < row_count) rows.add(now.row, azimuth, now);
        if (last != nullptr) fill_rows(*last, now, azimuth, rows);
      }
      if (shown) ranges.add(now.cell, azimuth, now);
      if (last != nullptr) fill_ranges(*last, now, azimuth, ranges);
      last = &now;
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
  FrameLayers layers = unseen(sensor, with_cscope);
  for (LayerSet* set : {&layers.bscope, &layers.cscope})
    set->double_bounce.assign(set->visibility.size(), 0.0F);
  return layers;
}

FrameLayers frame_layers(const World& world, const sensors::AntennaFrame& antenna,
                         const std::vector<core::Echo>& targets, bool with_cscope) {
  const sensors::Sensor& sensor = world.sensor;
  FrameLayers layers = unseen(sensor, with_cscope);
  const std::vector<std::vector<core::Echo>> of_column = by_column(targets, sensor.scan);
  const LayerCaster caster(world, antenna, with_cscope);
  // Neighbours by one thread: their cells lie side by side.
  const int blocks = (sensor.scan.columns + kBlockColumns - 1) / kBlockColumns;
  core::parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t block) {
    const int first = static_cast<int>(block) * kBlockColumns;
    const int last = std::min(first + kBlockColumns, sensor.scan.columns);
    caster.cast(first, last, of_column, layers);
  });
  find_angles(layers.bscope.grazing_rad);
  find_angles(layers.cscope.grazing_rad);
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
