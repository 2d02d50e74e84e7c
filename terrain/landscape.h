// Gentle generated country for scenes without terrain data: rolling ground, a patchwork of fields,
// woods.
//
// Ground: three octaves of smooth value noise (lattice 2000, 800 and 320 m). Fields: a Voronoi
// patchwork of jittered seeds. Woods: where a slow noise is high; the canopy is part of the
// surface, so woods shadow what is behind them. Everything follows from `seed` by counter-based
// random numbers.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/height_field.h"

namespace fanbeam::terrain {

struct LandscapeMaterials {
  std::vector<MaterialId> fields;  // drawn with equal chance
  MaterialId wood = 0;
  MaterialId airfield = 0;  // kept grass around the runway
};

struct LandscapeSettings {
  double relief_m = 8.0;  // peak to peak of the ground, roughly
  double field_size_m = 260.0;
  double wood_share = 0.15;  // of the area outside the airfield, roughly
  double canopy_m = 14.0;    // mean height of the woods
  std::uint64_t seed = 1;
};

class Landscape {
 public:
  Landscape(const LandscapeSettings& settings, LandscapeMaterials materials);

  // Ground height above the scene's base without trees.
  double ground_m(glm::dvec2 position_m) const;
  // Canopy above the ground, 0 outside woods. A wood ends within one post.
  double canopy_m(glm::dvec2 position_m) const;
  // Wood where woods stand, fields elsewhere.
  MaterialId material(glm::dvec2 position_m) const;
  // The field that would lie there without woods.
  MaterialId field(glm::dvec2 position_m) const;
  MaterialId airfield() const { return materials_.airfield; }

 private:
  double noise(glm::dvec2 position_m, double lattice_m, std::uint32_t octave) const;  // in [-1, 1]
  bool is_wood(glm::dvec2 position_m) const;

  LandscapeSettings settings_;
  LandscapeMaterials materials_;
  double wood_threshold_;
};

}  // namespace fanbeam::terrain
