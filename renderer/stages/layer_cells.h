// What is seen in a column of ground truth, summed in its cells over range or elevation. Private to the
// layers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "renderer/stages/frame_layers.h"

namespace fanbeam::renderer {

// Azimuths of a column, from the left, one bit each.
using AzimuthMask = std::uint32_t;

// What begins behind a share `left` of the column and takes `share` of it: one bit at least.
inline AzimuthMask azimuths_in(double left, double share) {
  constexpr double kBits = 32.0;
  const auto from = static_cast<int>(std::min(left * kBits + 0.5, kBits - 1.0));
  const auto to = static_cast<int>(std::min((left + share) * kBits + 0.5, kBits));
  const auto below = [](int bits) { return (std::uint64_t{1} << bits) - 1; };
  return static_cast<AzimuthMask>(below(std::max(to, from + 1)) & ~below(from));
}

// A part of what is seen in a cell, of one surface.
struct LayerEcho {
  double power_W = 0.0;
  double range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;  // nrcs: sigma0
  float elevation_rad = 0.0F;
  terrain::ObjectId object = terrain::kTerrainObject;
  terrain::MaterialId material = kNoMaterial;
};

class LayerCells {
 public:
  void clear(int cells) { cells_.assign(static_cast<std::size_t>(cells), Cell{}); }
  std::size_t size() const { return cells_.size(); }
  void add(int index, AzimuthMask azimuths, const LayerEcho& echo) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    // What sends nothing counts where nothing else is seen.
    const double weight = echo.power_W + 1e-60;
    cell.weight += weight;
    cell.range_m += weight * echo.range_m;
    cell.sin_grazing += weight * echo.sin_grazing;
    cell.nrcs += weight * echo.nrcs;
    cell.azimuths |= azimuths;
    elect(cell, weight, echo);
  }
  // After all surfaces: counts where it sends more than they together, in no mean.
  void add_target(int index, const LayerEcho& target) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    if (!(target.power_W > std::max(cell.weight, cell.part_W))) return;
    cell.part_W = target.power_W;
    cell.elevation_rad = target.elevation_rad;
    cell.object = target.object;
    cell.material = target.material;
  }
  // Whatever layers `set` has; the sine of the grazing angle in its place.
  void write(int column, int columns, LayerSet& set) const;

 private:
  struct alignas(64) Cell {
    double weight = 0.0, range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;
    double part_W = -1.0;  // the largest of those of one surface
    double lead_W = 0.0;
    float elevation_rad = 0.0F;
    terrain::ObjectId object = terrain::kTerrainObject;
    terrain::MaterialId material = kNoMaterial;
    AzimuthMask azimuths = 0;
  };
  // The surface that sends more than half of the cell's power is left in the end (the majority vote of
  // Boyer and Moore, with weights). Chosen rather than branched to: who leads is anyone's guess.
  static void elect(Cell& cell, double weight, const LayerEcho& echo) {
    const bool same = cell.object == echo.object && cell.material == echo.material;
    const double lead_W = cell.lead_W + (same ? weight : -weight);
    const bool beaten = lead_W < 0.0;
    const bool larger = beaten || (same && echo.power_W > cell.part_W);
    cell.lead_W = beaten ? -lead_W : lead_W;
    cell.object = beaten ? echo.object : cell.object;
    cell.material = beaten ? echo.material : cell.material;
    cell.part_W = larger ? echo.power_W : cell.part_W;
    cell.elevation_rad = larger ? echo.elevation_rad : cell.elevation_rad;
  }

  std::vector<Cell> cells_;
};

// Sines become angles.
void find_angles(std::vector<float>& grazing);

}  // namespace fanbeam::renderer
