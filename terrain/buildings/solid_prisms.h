// Extruded prisms as solids for a vertical cut, and which of them cannot be cut that way.
//
// A cut from above sees a building as solid down to the ground. That is so where a prism stands on
// the ground, and as good as so where buildings beneath a raised one fill the space under it: an
// upper storey, a tower on a hall. What is raised over open air (a bridge, a canopy) floats.
//
// Neglected: gaps under a raised prism that its supports leave, up to kGap_m high or beside them
// over 1 - kSupported of its footprint.
#pragma once

#include <cstddef>
#include <vector>

#include "terrain/buildings/extrusion.h"
#include "terrain/buildings/solids.h"

namespace fanbeam::terrain {

inline constexpr double kSupported = 0.99;  // share of the footprint
inline constexpr double kGap_m = 0.01;

// Adds what `extrude` made of `prisms` to `solids`: solids in the order of its polygons, and the
// boxes of floating polygons, whose number it returns. `object` by prism, or empty: the terrain.
// Raised prisms (not `on_ground`) look for support among `prisms` only.
std::size_t add_solids(const std::vector<Prism>& prisms, const Extrusion& extrusion,
                       MaterialId wall, MaterialId roof, const std::vector<ObjectId>& object,
                       Solids& solids);

// Around all vertices; `mesh` must have some.
Box_m box_around(const TriangleMesh& mesh);

// One for each part of the mesh that has triangles, as what a vertical cut cannot describe.
void add_boxes(const TriangleMesh& mesh, Solids& solids);

}  // namespace fanbeam::terrain
