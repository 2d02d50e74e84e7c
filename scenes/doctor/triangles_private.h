// The triangles of a mesh by their corners.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "terrain/mesh.h"

namespace fanbeam::scenes {

using Corners = std::array<glm::dvec3, 3>;

// Calls `use(index, corners_m)` for each.
template <class Use>
void for_triangles(const terrain::TriangleMesh& mesh, const Use& use) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    use(i, Corners{mesh.vertices_m[t.x], mesh.vertices_m[t.y], mesh.vertices_m[t.z]});
  }
}

}  // namespace fanbeam::scenes
