#include "session/labels/object_shapes.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace fanbeam::session {
namespace {

// Calls `body(object, triangle)` for every triangle of a mesh.
template <class Body>
void for_each_triangle(const terrain::RayScene& surfaces, const Body& body) {
  const std::uint32_t first = surfaces.terrain() != nullptr ? terrain::kTerrainGeometry + 1 : 0;
  for (std::uint32_t geometry = first; geometry < surfaces.geometry_count(); ++geometry)
    for (std::uint32_t i = 0; i < surfaces.mesh_triangles(geometry); ++i)
      body(surfaces.object(geometry, i, 0.0, 0.0), geometry, i);
}

}  // namespace

std::vector<ObjectShape> object_shapes(const terrain::RayScene& surfaces, std::size_t objects) {
  std::vector<std::size_t> count(objects, 0), seen(objects, 0);
  for_each_triangle(surfaces, [&](terrain::ObjectId object, std::uint32_t, std::uint32_t) {
    ++count[object];
  });
  std::vector<ObjectShape> shapes(objects);
  for_each_triangle(surfaces, [&](terrain::ObjectId object, std::uint32_t geometry,
                                  std::uint32_t primitive) {
    if (object == terrain::kTerrainObject) return;
    const std::array<glm::dvec3, 3> corners = surfaces.triangle(geometry, primitive);
    ObjectShape& shape = shapes[object];
    for (const glm::dvec3& corner : corners) {
      shape.box.low = glm::min(shape.box.low, corner);
      shape.box.high = glm::max(shape.box.high, corner);
    }
    // Every k-th of all.
    const std::size_t stride = (count[object] + kMostFacets - 1) / kMostFacets;
    if (seen[object]++ % stride != 0) return;
    shape.facets.push_back({(corners[0] + corners[1] + corners[2]) / 3.0,
                            0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0])});
  });
  return shapes;
}

}  // namespace fanbeam::session
