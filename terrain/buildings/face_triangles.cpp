#include "terrain/buildings/face_triangles.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

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
  std::map<std::pair<double, double>, std::uint32_t> corners;
  for (const std::vector<std::uint32_t>& ring : rings) {
    flat_m.emplace_back();
    for (const std::uint32_t index : ring) {
      flat_m.back().push_back(plane.flat_m(vertices_m[index]));
      corners[{flat_m.back().back().x, flat_m.back().back().y}] = index;
    }
  }
  if (rings.size() == 1 && outline.size() == 4 && is_convex(flat_m.front()))
    return std::vector<glm::uvec3>{{outline[0], outline[1], outline[2]},
                                   {outline[0], outline[2], outline[3]}};
  GEOSContextHandle_t context = geos.context();
  const Geos::Geometry polygon = geos.polygon(flat_m);
  if (!polygon) return std::nullopt;
  const Geos::Geometry parts =
      geos.own(GEOSConstrainedDelaunayTriangulation_r(context, polygon.get()));
  if (!parts) return std::nullopt;
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < GEOSGetNumGeometries_r(context, parts.get()); ++i) {
    Ring_m points =
        geos.ring_of(GEOSGetExteriorRing_r(context, GEOSGetGeometryN_r(context, parts.get(), i)));
    if (points.size() != 3) return std::nullopt;
    if (signed_area_m2(points) < 0.0) std::swap(points[1], points[2]);
    glm::uvec3 triangle{0};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2& point = points[static_cast<std::size_t>(k)];
      const auto corner = corners.find({point.x, point.y});
      if (corner == corners.end()) return std::nullopt;
      triangle[k] = corner->second;
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace fanbeam::terrain
