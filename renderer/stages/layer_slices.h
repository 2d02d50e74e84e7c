// Ground truth from azimuth slices (casting/profile): what the slice of a column sees, in the cells of
// both scopes. Private to the layers.
//
// Each visible piece lies on one facet of one surface, or on several of one plane (layer_pieces.h), and
// spans at most 8 mrad of elevation: its power, by the equation of slice_power.h, is shared among the
// cells that it crosses by the elevations that they take of it, that of an oblique wall by ranges. Over so
// short a piece ranges are linear in their inverse, but for the piece right below the antenna. NRCS and
// grazing angle are those in the middle of what a cell has. What is partly beyond the antenna's pattern is
// told to within 8 mrad of its end.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/casting/profile/slice_tracer.h"
#include "renderer/stages/layer_cells.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// What pieces are sorted into.
struct LayerGrid {
  explicit LayerGrid(const sensors::Sensor& sensor);

  int cells, rows;
  double minimum_m, cell_m, cells_per_m;
  double nearest_per_m, farthest_per_m;  // inverse ranges of the gate's ends
  double top_rad, rad_per_row;
  double lowest_rad, highest_rad;    // the ends of the antenna's pattern
  std::vector<double> border_per_m;  // inverse ranges between cells
};

class LayerSlices {
 public:
  // `frame` must outlive it.
  explicit LayerSlices(const SliceFrame& frame);

  // What slice `i` of the frame sees. No rows: ranges alone. Thread-safe.
  void add(std::size_t i, LayerCells& ranges, LayerCells& rows) const;

 private:
  void add(const Slice& slice, VisiblePieces& pieces, LayerCells& ranges, LayerCells& rows) const;

  const SliceFrame& frame_;
  LayerGrid grid_;
  double constant_W_m2_;
};

}  // namespace fanbeam::renderer
