// What objects of a scene look like from outside: some of the triangles of each, and the box around all
// of them. Made once for a site; const.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "terrain/buildings/solids.h"
#include "terrain/ray_scene.h"

namespace fanbeam::session {

struct Facet {
  glm::dvec3 middle_m{0.0};
  glm::dvec3 outwards_m2{0.0};  // normal of the length of its area
};

struct ObjectShape {
  terrain::Box_m box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  std::vector<Facet> facets;  // kMostFacets at most, evenly among all
  bool there() const { return !facets.empty(); }
};

// By terrain::ObjectId; terrain and what is painted on it has none.
inline constexpr std::size_t kMostFacets = 64;
std::vector<ObjectShape> object_shapes(const terrain::RayScene& surfaces, std::size_t objects);

}  // namespace fanbeam::session
