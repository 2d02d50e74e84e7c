// How far a new scene's terrain reaches, as far as there are elevation data.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/geodetic.h"

namespace fanbeam::scenes {

// All positive, from the origin.
struct TerrainExtent {
  double west_m = 0.0, east_m = 0.0, south_m = 0.0, north_m = 0.0;
};

// The smallest extent around all these places, `margin_m` to spare on each side.
TerrainExtent extent_around(const core::Geodetic& origin, const std::vector<core::Geodetic>& places,
                            double margin_m);

// The largest extent between `least` and `most` whose border `covers` everywhere, searched in steps
// of 50 m of the sides that stick out; nothing where not even `least` is covered.
std::optional<TerrainExtent> covered_extent(
    const core::Geodetic& origin, const TerrainExtent& least, const TerrainExtent& most,
    const std::function<bool(const core::Geodetic&)>& covers);

}  // namespace fanbeam::scenes
