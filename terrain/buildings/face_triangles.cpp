#include "terrain/buildings/face_triangles.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {
namespace {

constexpr double kLeastNormal_m2 = 1e-6;

// The plane of a face, from one of its corners: seen from outside, u is right and v is up.
struct FacePlane {
  glm::dvec3 origin_m, u, v;

  FacePlane(const glm::dvec3& corner_m, const glm::dvec3& normal) : origin_m(corner_m) {
    const glm::dvec3 beside =
        std::abs(normal.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    u = glm::normalize(glm::cross(beside, normal));
    v = glm::cross(normal, u);
  }
  glm::dvec2 flat_m(const glm::dvec3& point_m) const {
    return {glm::dot(point_m - origin_m, u), glm::dot(point_m - origin_m, v)};
  }
};

double turn_m2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_convex(const Ring_m& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!(turn_m2(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) > 0.0))
      return false;
  return true;
}

}  // namespace

glm::dvec3 face_normal_m2(const std::vector<glm::dvec3>& vertices_m,
                          const std::vector<std::uint32_t>& outline) {
  glm::dvec3 sum(0.0);
  const glm::dvec3& origin_m = vertices_m[outline.front()];
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum += glm::cross(vertices_m[outline[i]] - origin_m, vertices_m[outline[i + 1]] - origin_m);
  return sum;
}

std::optional<std::vector<glm::uvec3>> face_triangles(const std::vector<glm::dvec3>& vertices_m,
                                                      const FaceRings& rings, const Geos& geos) {
  const std::vector<std::uint32_t>& outline = rings.front();
  const glm::dvec3 normal_m2 = face_normal_m2(vertices_m, outline);
  if (!(glm::length(normal_m2) > kLeastNormal_m2)) return std::vector<glm::uvec3>{};
  if (rings.size() == 1 && outline.size() == 3)
    return std::vector<glm::uvec3>{{outline[0], outline[1], outline[2]}};
  const FacePlane plane(vertices_m[outline.front()], glm::normalize(normal_m2));
  Polygon_m flat_m;
  std::vector<std::uint32_t> vertex_of;  // by the points of all rings
  for (const std::vector<std::uint32_t>& ring : rings) {
    flat_m.emplace_back();
    for (const std::uint32_t index : ring) flat_m.back().push_back(plane.flat_m(vertices_m[index]));
    vertex_of.insert(vertex_of.end(), ring.begin(), ring.end());
  }
  if (rings.size() == 1 && outline.size() == 4 && is_convex(flat_m.front()))
    return std::vector<glm::uvec3>{{outline[0], outline[1], outline[2]},
                                   {outline[0], outline[2], outline[3]}};
  std::optional<std::vector<glm::uvec3>> triangles = geos.triangulate(flat_m);
  if (triangles)
    for (glm::uvec3& triangle : *triangles)
      triangle = {vertex_of[triangle.x], vertex_of[triangle.y], vertex_of[triangle.z]};
  return triangles;
}

}  // namespace fanbeam::terrain
