#include "renderer/stages/frame_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/profile/slice_exclusion.h"
#include "renderer/casting/profile/slice_layout.h"
#include "renderer/casting/profile/slice_scene.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/layer_cells.h"
#include "renderer/stages/layer_lines.h"
#include "renderer/stages/layer_slices.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

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
  FrameLayers layers;
  const int columns = sensor.scan.columns;
  // Megabytes of fresh pages: a scope each.
  core::parallel_for(with_cscope ? 2 : 1, [&](std::size_t scope) {
    if (scope == 0)
      layers.bscope = empty_set(sensor.range.cells, columns, &LayerSet::elevation_rad);
    else
      layers.cscope = empty_set(sensor.display.cscope_rows, columns, &LayerSet::range_m);
  });
  return layers;
}

// Which azimuths of a column the line of that number stands for.
AzimuthMask azimuths_of_line(int line) {
  return azimuths_in(static_cast<double>(line) / kLayerAzimuths, 1.0 / kLayerAzimuths);
}

// What is seen in each column, in the cells of both scopes: of those marked in `by_rays` from rays, of
// the others from `slices`, one in the middle of each column.
class LayerColumns {
 public:
  LayerColumns(const World& world, const sensors::AntennaFrame& antenna, bool with_cscope,
               std::vector<std::uint8_t> by_rays, const LayerSlices* slices)
      : world_(world),
        with_cscope_(with_cscope),
        by_rays_(std::move(by_rays)),
        slices_(slices),
        cell_m_(static_cast<float>(world.sensor.range.cell_m)),
        row_rad_(static_cast<float>(cscope_row_rad(world.sensor.display))) {
    if (std::find(by_rays_.begin(), by_rays_.end(), 1) != by_rays_.end())
      lines_.emplace(world, antenna);
  }

  // Columns [first, last), at most kBlockColumns.
  void fill(int first, int last, const std::vector<std::vector<core::Echo>>& targets,
            FrameLayers& layers) const {
    thread_local std::array<LayerLine, kBlockLines> lines;
    if (lines_) lines_->cast(first, last, by_rays_, lines);
    thread_local LayerCells ranges, rows;
    const sensors::Sensor& sensor = world_.sensor;
    for (int column = first; column < last; ++column) {
      ranges.clear(sensor.range.cells);
      rows.clear(with_cscope_ ? sensor.display.cscope_rows : 0);
      const auto of_column = static_cast<std::size_t>(column);
      if (by_rays_[of_column] == 0)
        slices_->add(of_column, ranges, rows);
      else
        for (int k = 0; k < kLayerAzimuths; ++k)
          deposit(lines[static_cast<std::size_t>((column - first) * kLayerAzimuths + k)],
                  azimuths_of_line(k), ranges, rows);
      for (const core::Echo& echo : targets[of_column]) add(echo, ranges, rows);
      ranges.write(column, sensor.scan.columns, layers.bscope);
      if (with_cscope_) rows.write(column, sensor.scan.columns, layers.cscope);
    }
  }

 private:
  void add(const core::Echo& echo, LayerCells& ranges, LayerCells& rows) const {
    const LayerEcho target{
        .power_W = echo.power_W,
        .range_m = echo.range_m,
        .elevation_rad = static_cast<float>(echo.elevation_rad),
        .object =
            static_cast<terrain::ObjectId>(world_.geometry->object_names.size()) + echo.object_id};
    const int cell = sensors::range_row(world_.sensor.range, echo.range_m);
    if (cell != sensors::kOutside) ranges.add_target(cell, target);
    const int row = with_cscope_ ? sensors::cscope_row(world_.sensor.display, echo.elevation_rad)
                                 : sensors::kOutside;
    if (row != sensors::kOutside) rows.add_target(row, target.compensated());
  }

  // Between two neighbours on the ground: it has the cover and the paint of its own place.
  void cover(const LayerHit& a, const LayerHit& b, LayerHit& hit) const {
    const terrain::SurfaceMap::Cover here = world_.surfaces().surface_map()->cover_at(
        static_cast<double>(hit.x_m), static_cast<double>(hit.y_m));
    hit.object = here.object;
    hit.material = here.material;
    if (hit.material == a.material && hit.material == b.material) return;
    const auto sine = static_cast<double>(hit.sin_grazing);
    const auto nrcs =
        static_cast<float>(world_.nrcs.tables()[hit.material].sigma0_over_sine(sine) * sine);
    if (hit.nrcs > 0.0F) hit.power_W_per_rad *= nrcs / hit.nrcs;
    hit.nrcs = nrcs;
  }

  bool in_gate(const LayerHit& hit) const {
    const auto range_m = static_cast<double>(hit.range_m);
    return range_m >= world_.sensor.range.minimum_m && range_m < world_.sensor.range.maximum_m();
  }
  bool in_gate(int cell) const { return cell >= 0 && cell < world_.sensor.range.cells; }

  void fill_ranges(const LayerHit& a, const LayerHit& b, AzimuthMask azimuth,
                   LayerCells& ranges) const {
    const int gap = std::abs(b.cell - a.cell);
    if (gap < 2 || !lines_->one_slope(a, b)) return;
    const LayerGap between(a, b);
    const bool ground = lines_->is_ground(a);
    const float height_rad = std::abs(b.elevation_rad - a.elevation_rad) / static_cast<float>(gap);
    for (int cell = std::min(a.cell, b.cell) + 1; cell < std::max(a.cell, b.cell); ++cell) {
      if (!in_gate(cell)) continue;
      LayerHit hit = between.at_range(
          static_cast<float>(sensors::range_middle_m(world_.sensor.range, cell)), height_rad);
      if (ground) cover(a, b, hit);
      ranges.add(cell, azimuth, hit.echo());
    }
  }

  // Rows between two neighbours: what they both meet, or each its half.
  void fill_rows(const LayerHit& a, const LayerHit& b, AzimuthMask azimuth,
                 LayerCells& rows) const {
    const int first = std::max(std::min(a.row, b.row) + 1, 0);
    const int last = std::min(std::max(a.row, b.row), world_.sensor.display.cscope_rows) - 1;
    if (first > last) return;
    const LayerGap between(a, b);
    const bool one = a.surface == b.surface, ground = one && lines_->is_ground(a);
    const float per_row = 1.0F / static_cast<float>(b.row - a.row);
    for (int row = first; row <= last; ++row) {
      const float share = static_cast<float>(row - a.row) * per_row;
      LayerHit hit = one ? between.at(share, row_rad_) : (share < 0.5F ? a : b).within(row_rad_);
      if (!in_gate(hit)) continue;
      if (ground) cover(a, b, hit);
      rows.add(row, azimuth, hit.echo().compensated());
    }
  }

  void deposit(const LayerLine& line, AzimuthMask azimuth, LayerCells& ranges,
               LayerCells& rows) const {
    const int row_count = world_.sensor.display.cscope_rows;
    const LayerHit* last = nullptr;
    for (const LayerHit& now : line) {
      if (!now.hit()) {
        last = nullptr;
        continue;
      }
      const bool shown = in_gate(now.cell);
      if (with_cscope_) {
        if (shown && now.row >= 0 && now.row < row_count)
          rows.add(now.row, azimuth, now.within(row_rad_).echo().compensated());
        if (last != nullptr) fill_rows(*last, now, azimuth, rows);
      }
      // What a cell of this slope takes of the elevations.
      const float cell_rad = cell_m_ / std::max(std::abs(now.range_m * now.range_slope), 1e-3F);
      if (shown) ranges.add(now.cell, azimuth, now.within(cell_rad).echo());
      if (last != nullptr) fill_ranges(*last, now, azimuth, ranges);
      last = &now;
    }
  }

  const World& world_;
  bool with_cscope_;
  std::vector<std::uint8_t> by_rays_;
  const LayerSlices* slices_;
  std::optional<LayerLines> lines_;  // where some column needs them
  float cell_m_, row_rad_;
};

}  // namespace

const std::string* object_name(const World& world, terrain::ObjectId object) {
  const std::vector<std::string>& names = world.geometry->object_names;
  if (object < names.size()) return &names[object];
  const std::size_t target = object - names.size();
  return target < world.targets.size() ? &world.targets[target].name : nullptr;
}

FrameLayers empty_layers(const sensors::Sensor& sensor, bool with_cscope) {
  FrameLayers layers = unseen(sensor, with_cscope);
  for (LayerSet* set : {&layers.bscope, &layers.cscope})
    set->double_bounce.assign(set->visibility.size(), 0.0F);
  return layers;
}

GroundTruth::GroundTruth(const World& world) : world_(world) {
  const sensors::Sensor& sensor = world.sensor;
  if (world.surfaces().terrain() != nullptr && sensor.scan.field_of_view_rad <= kWidestSlices_rad)
    slices_ = std::make_unique<const SliceScene>(world);
}

GroundTruth::~GroundTruth() = default;

FrameLayers GroundTruth::of(const sensors::AntennaFrame& antenna,
                            const std::vector<core::Echo>& targets, bool with_cscope) const {
  const sensors::Sensor& sensor = world_.sensor;
  FrameLayers layers = unseen(sensor, with_cscope);
  const std::vector<std::vector<core::Echo>> of_column = by_column(targets, sensor.scan);
  const auto fill = [&](std::vector<std::uint8_t> by_rays, const LayerSlices* slices) {
    const LayerColumns in_columns(world_, antenna, with_cscope, std::move(by_rays), slices);
    // Neighbours by one thread: their cells lie side by side.
    const int blocks = (sensor.scan.columns + kBlockColumns - 1) / kBlockColumns;
    core::parallel_for(static_cast<std::size_t>(blocks), [&](std::size_t block) {
      const int first = static_cast<int>(block) * kBlockColumns;
      const int last = std::min(first + kBlockColumns, sensor.scan.columns);
      in_columns.fill(first, last, of_column, layers);
    });
  };
  if (slices_ && azimuths_are_upright(antenna, sensor.scan.surface)) {
    FanSums fan;
    fan.sub_columns = sensor.scan.columns;
    fan.first_azimuth_rad = sensors::column_edge_rad(sensor.scan, 0);
    fan.step_rad = sensor.scan.column_width_rad();
    const std::vector<Slice> slices = level_slices(world_, 1, antenna, fan);
    SightLines none;
    slices_->in_frame(antenna, slices, 1, none, [&](const SliceFrame& frame) {
      const LayerSlices of_columns(frame);
      fill(sub_columns_for_rays(world_, antenna, slices, 1, fan), &of_columns);
    });
  } else {
    fill(std::vector<std::uint8_t>(static_cast<std::size_t>(sensor.scan.columns), 1), nullptr);
  }
  find_angles(layers.bscope.grazing_rad);
  find_angles(layers.cscope.grazing_rad);
  return layers;
}

std::vector<float> share_of(const std::vector<double>& part, const std::vector<double>& total) {
  std::vector<float> share(total.size(), 0.0F);
  for (std::size_t i = 0; i < total.size(); ++i)
    if (part[i] > 0.0) share[i] = static_cast<float>(std::min(part[i] / total[i], 1.0));
  return share;
}

}  // namespace fanbeam::renderer
