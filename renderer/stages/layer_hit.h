// What one ray of ground truth met, and what lies between two of them. Private to the layers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/stages/layer_cells.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

// One ray, which stands for a strip of elevation.
struct LayerHit {
  float elevation_rad = 0.0F, height_rad = 0.0F;
  float power_W_per_rad = 0.0F;  // of elevation, at full azimuth gain
  float range_m = 0.0F, sin_grazing = 0.0F, nrcs = 0.0F;
  float x_m = 0.0F, y_m = 0.0F;             // of the scene
  float range_slope = 0.0F;                 // ray_chain.h
  std::uint32_t surface = terrain::kNoHit;  // and nothing else but the elevation means anything
  std::int32_t cell = 0, row = 0;  // of the picture's range and elevation; both count on outside
  terrain::ObjectId object = terrain::kTerrainObject;
  terrain::MaterialId material = kNoMaterial;

  bool hit() const { return surface != terrain::kNoHit; }
  // No more than this of its strip.
  LayerHit within(float most_rad) const {
    LayerHit part = *this;
    part.height_rad = std::min(height_rad, most_rad);
    return part;
  }
  LayerEcho echo() const {
    return {.power_W = static_cast<double>(power_W_per_rad * height_rad),
            .range_m = static_cast<double>(range_m),
            .sin_grazing = static_cast<double>(sin_grazing),
            .nrcs = static_cast<double>(nrcs),
            .elevation_rad = elevation_rad,
            .object = object,
            .material = material};
  }
};

// What lies between two rays that met one surface; of the nearer one what has no middle. Ranges of a
// plane are linear in their inverse.
class LayerGap {
 public:
  LayerGap(const LayerHit& a, const LayerHit& b)
      : a_(a),
        b_(b),
        way_m_(b.range_m - a.range_m),
        per_way_(std::abs(way_m_) > 0.0F ? 1.0F / way_m_ : 0.0F) {}

  // At a share of the elevations between them; stands for `height_rad`.
  LayerHit at(float share, float height_rad) const {
    return at(share, a_.range_m * b_.range_m / (b_.range_m - share * way_m_), height_rad);
  }
  // At a range between theirs, which differ.
  LayerHit at_range(float range_m, float height_rad) const {
    return at(b_.range_m * (range_m - a_.range_m) * per_way_ / range_m, range_m, height_rad);
  }

 private:
  LayerHit at(float share, float range_m, float height_rad) const {
    const auto mix = [](float by, float x, float y) { return x + by * (y - x); };
    const LayerHit& nearer = share < 0.5F ? a_ : b_;
    const float along = (range_m - a_.range_m) * per_way_;
    LayerHit hit;
    hit.elevation_rad = mix(share, a_.elevation_rad, b_.elevation_rad);
    hit.height_rad = height_rad;
    hit.power_W_per_rad = mix(share, a_.power_W_per_rad, b_.power_W_per_rad);
    hit.range_m = range_m;
    hit.sin_grazing = mix(share, a_.sin_grazing, b_.sin_grazing);
    hit.nrcs = mix(share, a_.nrcs, b_.nrcs);
    hit.x_m = mix(along, a_.x_m, b_.x_m);
    hit.y_m = mix(along, a_.y_m, b_.y_m);
    hit.surface = nearer.surface;
    hit.object = nearer.object;
    hit.material = nearer.material;
    return hit;
  }

  const LayerHit &a_, &b_;
  float way_m_, per_way_;
};

}  // namespace fanbeam::renderer
