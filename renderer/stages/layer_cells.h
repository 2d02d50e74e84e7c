// What the rays of a column of ground truth met, and the sums of its cells over range or elevation.
// Private to frame_layers.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "renderer/stages/frame_layers.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

// One ray, which stands for a strip of elevation.
struct LayerHit {
  float elevation_rad = 0.0F, height_rad = 0.0F;
  float power_W_per_rad = 0.0F;  // of elevation, at full azimuth gain
  float range_m = 0.0F, sin_grazing = 0.0F, nrcs = 0.0F;
  float x_m = 0.0F, y_m = 0.0F;             // of the scene
  float range_slope = 0.0F;                 // ray_chain.h
  std::uint32_t surface = terrain::kNoHit;  // and nothing else but the strip means anything
  std::int32_t cell = 0, row = 0;  // of the picture's range and elevation; both count on outside
  terrain::ObjectId object = terrain::kTerrainObject;
  terrain::MaterialId material = kNoMaterial;

  bool hit() const { return surface != terrain::kNoHit; }
  float power_W() const { return power_W_per_rad * height_rad; }
};

// Between two rays that met one surface; of the nearer one what has no middle. Ranges of a plane are
// linear in their inverse.
inline LayerHit between(const LayerHit& a, const LayerHit& b, float share) {
  const auto mix = [share](float x, float y) { return x + share * (y - x); };
  LayerHit hit = share < 0.5F ? a : b;
  hit.range_m = a.range_m * b.range_m / mix(b.range_m, a.range_m);
  hit.elevation_rad = mix(a.elevation_rad, b.elevation_rad);
  hit.sin_grazing = mix(a.sin_grazing, b.sin_grazing);
  hit.nrcs = mix(a.nrcs, b.nrcs);
  const float way_m = b.range_m - a.range_m;
  const float along = std::abs(way_m) > 0.0F ? (hit.range_m - a.range_m) / way_m : share;
  hit.x_m = a.x_m + along * (b.x_m - a.x_m);
  hit.y_m = a.y_m + along * (b.y_m - a.y_m);
  hit.height_rad = 1.0F;
  hit.power_W_per_rad = mix(a.power_W(), b.power_W());
  return hit;
}

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
  // Counts where it is the strongest, in no mean.
  void add_target(int index, const LayerHit& target) {
    keep_strongest(cells_[static_cast<std::size_t>(index)], target);
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
