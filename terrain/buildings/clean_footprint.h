// Footprints made fit for walls, roofs and vertical cuts.
//
// Rings that cross or touch themselves are repaired by GEOS (MakeValid, by linework): a place is
// inside when an odd number of rings is around it, and a courtyard that shares part of an edge with
// its outline is filled. The result leaves no doubt: every ring is simple, two rings meet in single
// points at most, and so the parity of crossings, the side of an edge and the direction of a ring
// all say the same about what is inside.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace fanbeam::terrain {

// The last point is not the first again.
using Ring_m = std::vector<glm::dvec2>;

// The outline, counter-clockwise, then the courtyards, clockwise: the inside lies on the left of
// every edge.
using Polygon_m = std::vector<Ring_m>;

// Rings with less area are slivers and go: coordinates of 1000 km are rounded by 1e-10 m, which
// moves an outline of 100 m by this much.
inline constexpr double kSliver_m2 = 1e-8;

// With the sign of the direction: positive counter-clockwise.
double signed_area_m2(const Ring_m& ring);

// Rings in either direction, of finite coordinates up to kLargestCoordinate_m. No repeated points
// in the result. It has several polygons when a ring crosses itself, none when nothing is inside.
std::vector<Polygon_m> clean_footprint(const Ring_m& outer_m, const std::vector<Ring_m>& holes_m);

}  // namespace fanbeam::terrain
