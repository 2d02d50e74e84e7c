// Flat-roofed buildings: polygons with courtyards pulled up into prisms.
//
// Walls stand along the z axis of the local frame (10 km from its origin the plumb line leans from
// it by 1.6 mrad: 3 cm on a 20 m wall). Roofs are triangulated without further vertices (GEOS,
// constrained Delaunay). There is no floor: nothing looks at a building from below.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/errors.h"
#include "terrain/buildings/clean_footprint.h"
#include "terrain/mesh.h"

namespace fanbeam::terrain {

// Rings of at least three points, in either direction.
struct Prism {
  Ring_m outer_m;
  std::vector<Ring_m> holes_m;
  double bottom_m = 0.0;
  double top_m = 0.0;
  bool on_ground = true;  // its walls reach into the ground; else there is air under its bottom
};

struct ExtrusionMaterials {
  std::string wall = "wall";
  std::string roof = "roof";
};

// Material slots of the mesh.
inline constexpr std::uint32_t kWallSlot = 0;
inline constexpr std::uint32_t kRoofSlot = 1;

// What walls and roof were made of. A repaired prism may have several.
struct ExtrudedPolygon {
  Polygon_m rings_m;
  std::uint32_t prism = 0;  // index
};

struct Extrusion {
  TriangleMesh mesh;  // its parts are the prisms, by index
  std::vector<ExtrudedPolygon> polygons;
  std::size_t failed = 0;
};

// Footprints are repaired first (clean_footprint.h). `name` goes into the mesh and the messages. Errors: E-NONFINITE, E-RANGE (a coordinate beyond kLargestCoordinate_m),
// with the prism's index; the prism is left out. Warnings: W-DEGENERATE with the count of prisms
// without area or height, W-SKIPPED with the count that GEOS could not triangulate; together
// they are `failed`.
Extrusion extrude(const std::vector<Prism>& prisms, const std::string& name,
                  const ExtrusionMaterials& materials, core::ProblemList& problems);

}  // namespace fanbeam::terrain
