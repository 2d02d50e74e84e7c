// A flat face in space, with holes, as triangles.
//
// The face is laid flat along its mean normal (Newell's sum) and triangulated by GEOS (constrained
// Delaunay, no further vertices); triangles and convex quadrilaterals need no GEOS. A face that is not
// quite flat keeps its corners where they are.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace fanbeam::terrain {

class Geos;

// Indices of vertices, the last not the first again. The first ring is the outline, counter-clockwise
// seen from outside; of the holes either direction will do.
using FaceRings = std::vector<std::vector<std::uint32_t>>;

// Twice the area, along the outward normal; right also for outlines that are not quite flat.
glm::dvec3 face_normal_m2(const std::vector<glm::dvec3>& vertices_m,
                          const std::vector<std::uint32_t>& outline);

// Counter-clockwise seen from outside. Empty for a face without area, nothing for one that GEOS cannot
// triangulate.
std::optional<std::vector<glm::uvec3>> face_triangles(const std::vector<glm::dvec3>& vertices_m,
                                                      const FaceRings& rings, const Geos& geos);

}  // namespace fanbeam::terrain
