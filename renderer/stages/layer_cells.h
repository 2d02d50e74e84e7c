// What the rays of a column of ground truth met, and the sums of its cells over range or elevation.
// Private to frame_layers.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/stages/layer_hit.h"

namespace fanbeam::renderer {

class LayerCells {
 public:
  void clear(int cells) { cells_.assign(static_cast<std::size_t>(cells), Cell{}); }
  // Of the column's azimuth of that number; azimuths one after the other.
  void add(int index, int azimuth, const LayerHit& hit) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    // What sends nothing counts where nothing else is seen.
    const double weight = static_cast<double>(hit.power_W()) + 1e-60;
    cell.weight += weight;
    cell.range_m += weight * static_cast<double>(hit.range_m);
    cell.sin_grazing += weight * static_cast<double>(hit.sin_grazing);
    cell.nrcs += weight * static_cast<double>(hit.nrcs);
    if (cell.last_azimuth != azimuth) {
      cell.last_azimuth = static_cast<std::int8_t>(azimuth);
      ++cell.azimuths;
    }
    keep_strongest(cell, hit);
  }
  // After all surfaces: counts where it sends more than they together, in no mean.
  void add_target(int index, const LayerHit& target) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    if (static_cast<double>(target.power_W()) > cell.weight) keep_strongest(cell, target);
  }
  // Whatever layers `set` has; the sine of the grazing angle in its place.
  void write(int column, int columns, int azimuths, LayerSet& set) const;

 private:
  struct Cell {
    double weight = 0.0, range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;
    float strongest_W = -1.0F, elevation_rad = 0.0F;
    terrain::ObjectId object = terrain::kTerrainObject;
    terrain::MaterialId material = 0;
    std::int8_t azimuths = 0, last_azimuth = -1;
  };
  static void keep_strongest(Cell& cell, const LayerHit& hit) {
    const float power_W = hit.power_W();
    if (!(power_W > cell.strongest_W)) return;
    cell.strongest_W = power_W;
    cell.elevation_rad = hit.elevation_rad;
    cell.object = hit.object;
    cell.material = hit.material;
  }

  std::vector<Cell> cells_;
};

// Sines become angles.
void find_angles(std::vector<float>& grazing);

}  // namespace fanbeam::renderer
