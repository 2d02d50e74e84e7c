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
  double power_W = 0.0;  // in cells of the C-scope, which sums P R^3: W m^3
  double range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;  // nrcs: sigma0
  float elevation_rad = 0.0F;
  terrain::ObjectId object = terrain::kTerrainObject;
  terrain::MaterialId material = kNoMaterial;

  // As it counts in the C-scope. Part of the loops that call it: layer_slices.cpp.
  [[gnu::always_inline]] LayerEcho compensated() const {
    LayerEcho echo = *this;
    echo.power_W *= range_m * range_m * range_m;
    return echo;
  }
};

class LayerCells {
 public:
  void clear(int cells) { cells_.assign(static_cast<std::size_t>(cells), Cell{}); }
  std::size_t size() const { return cells_.size(); }
  void add(int index, AzimuthMask azimuths, const LayerEcho& echo) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    // What sends nothing counts where nothing else is seen.
    const double weight = echo.power_W + kLeast_W;
    cell.weight += weight;
    cell.range_m += weight * echo.range_m;
    cell.sin_grazing += weight * echo.sin_grazing;
    cell.nrcs += weight * echo.nrcs;
    cell.azimuths |= azimuths;
    elect(cell, static_cast<float>(weight), echo);
  }
  // After all surfaces: counts where it sends more than they together, in no mean.
  void add_target(int index, const LayerEcho& target) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    const auto power_W = static_cast<float>(target.power_W);
    if (!(target.power_W > cell.weight && power_W > cell.part_W)) return;
    cell.part_W = power_W;
    cell.elevation_rad = target.elevation_rad;
    cell.object = target.object;
    cell.material = target.material;
  }
  // Whatever layers `set` has; the sine of the grazing angle in its place.
  void write(int column, int columns, LayerSet& set) const;

 private:
  static constexpr double kLeast_W = 1e-36;  // floats hold it
  static constexpr terrain::ObjectId kNobody = ~terrain::ObjectId{0};

  struct alignas(64) Cell {
    double weight = 0.0, range_m = 0.0, sin_grazing = 0.0, nrcs = 0.0;
    float lead_W = 0.0F, material_lead_W = 0.0F;
    float part_W = -1.0F;  // the largest of the object's since it took the lead
    float elevation_rad = 0.0F;
    terrain::ObjectId object = kNobody;
    terrain::MaterialId material = kNoMaterial;
    AzimuthMask azimuths = 0;
  };
  // The object that sends more than half of the cell's power is left in the end, and of it the material
  // that sends more than half since it took the lead (the majority vote of Boyer and Moore, with weights).
  static void elect(Cell& cell, float weight, const LayerEcho& echo) {
    if (cell.object != echo.object) {
      cell.lead_W -= weight;
      if (cell.lead_W < 0.0F) lead(cell, weight, echo);
      return;
    }
    cell.lead_W += weight;
    if (cell.material == echo.material) {
      cell.material_lead_W += weight;
    } else if ((cell.material_lead_W -= weight) < 0.0F) {
      cell.material_lead_W = -cell.material_lead_W;
      cell.material = echo.material;
    }
    const auto power_W = static_cast<float>(echo.power_W);
    const bool larger = power_W > cell.part_W;
    cell.part_W = larger ? power_W : cell.part_W;
    cell.elevation_rad = larger ? echo.elevation_rad : cell.elevation_rad;
  }
  static void lead(Cell& cell, float weight, const LayerEcho& echo) {
    cell.lead_W = -cell.lead_W;
    cell.material_lead_W = weight;
    cell.part_W = static_cast<float>(echo.power_W);
    cell.elevation_rad = echo.elevation_rad;
    cell.object = echo.object;
    cell.material = echo.material;
  }

  std::vector<Cell> cells_;
};

// Sines become angles.
void find_angles(std::vector<float>& grazing);

}  // namespace fanbeam::renderer
