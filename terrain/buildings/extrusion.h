// Flat-roofed buildings: polygons with courtyards pulled up into prisms.
//
// Walls stand along the z axis of the local frame (10 km from its origin the plumb line leans from
// it by 1.6 mrad: 3 cm on a 20 m wall). Roofs are triangulated without further vertices (GEOS,
// constrained Delaunay). There is no floor: nothing looks at a building from below.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/mesh.h"

namespace fanbeam::terrain {

using Ring_m = std::vector<glm::dvec2>;

// Rings of at least three points, in either direction, the last point not the first again.
struct Prism {
  Ring_m outer_m;
  std::vector<Ring_m> holes_m;
  double bottom_m = 0.0;
  double top_m = 0.0;
};

struct ExtrusionMaterials {
  std::string wall = "wall";
  std::string roof = "roof";
};

// Material slots of the mesh.
inline constexpr std::uint32_t kWallSlot = 0;
inline constexpr std::uint32_t kRoofSlot = 1;

struct Extrusion {
  TriangleMesh mesh;
  // Which prism each triangle belongs to.
  std::vector<std::uint32_t> triangle_prism;
  std::size_t failed = 0;
};

// Rings that cross or touch themselves are repaired first (GEOS MakeValid). `name` goes into the
// mesh and the messages. Errors: E-NONFINITE, E-RANGE (a coordinate beyond kLargestCoordinate_m),
// with the prism's index; the prism is left out. Warnings: W-DEGENERATE with the count of prisms
// without area or height, W-SKIPPED with the count that GEOS could not triangulate; together
// they are `failed`.
Extrusion extrude(const std::vector<Prism>& prisms, const std::string& name,
                  const ExtrusionMaterials& materials, core::ProblemList& problems);

}  // namespace fanbeam::terrain
