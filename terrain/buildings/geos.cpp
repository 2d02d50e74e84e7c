#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {

Geos::Geometry Geos::linear_ring(const Ring_m& ring) const {
  const auto count = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* points = GEOSCoordSeq_create_r(context(), count + 1, 2);
  for (unsigned i = 0; i <= count; ++i)
    GEOSCoordSeq_setXY_r(context(), points, i, ring[i % count].x, ring[i % count].y);
  return own(GEOSGeom_createLinearRing_r(context(), points));
}

Geos::Geometry Geos::polygon(const Polygon_m& rings_m) const {
  if (rings_m.empty() || rings_m.front().size() < 3) return own(nullptr);
  Geometry outer = linear_ring(rings_m.front());
  std::vector<GEOSGeometry*> holes;
  for (std::size_t i = 1; i < rings_m.size(); ++i)
    if (rings_m[i].size() >= 3) holes.push_back(linear_ring(rings_m[i]).release());
  return own(GEOSGeom_createPolygon_r(context(), outer.release(), holes.data(),
                                      static_cast<unsigned>(holes.size())));
}

Ring_m Geos::ring_of(const GEOSGeometry* linear_ring) const {
  const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(context(), linear_ring);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(context(), points, &count);
  Ring_m ring;
  for (unsigned i = 0; i < count; ++i) {
    glm::dvec2 point{0.0};
    GEOSCoordSeq_getXY_r(context(), points, i, &point.x, &point.y);
    if (ring.empty() || point != ring.back()) ring.push_back(point);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  return ring;
}

std::optional<std::vector<glm::uvec3>> Geos::triangulate(const Polygon_m& rings_m) const {
  const Geometry outline = polygon(rings_m);
  if (!outline) return std::nullopt;
  const Geometry parts = own(GEOSConstrainedDelaunayTriangulation_r(context(), outline.get()));
  if (!parts) return std::nullopt;
  std::map<std::pair<double, double>, std::uint32_t> corners;
  std::uint32_t index = 0;
  for (const Ring_m& ring : rings_m)
    for (const glm::dvec2& point : ring) corners[{point.x, point.y}] = index++;
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < GEOSGetNumGeometries_r(context(), parts.get()); ++i) {
    Ring_m points =
        ring_of(GEOSGetExteriorRing_r(context(), GEOSGetGeometryN_r(context(), parts.get(), i)));
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

bool Geos::is_counter_clockwise(const GEOSGeometry* linear_ring) const {
  char answer = 0;
  GEOSCoordSeq_isCCW_r(context(), GEOSGeom_getCoordSeq_r(context(), linear_ring), &answer);
  return answer != 0;
}

}  // namespace fanbeam::terrain
