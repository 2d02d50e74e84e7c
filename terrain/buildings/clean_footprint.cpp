#include "terrain/buildings/clean_footprint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/buildings/geos_private.h"

namespace fanbeam::terrain {
namespace {

// Empty for a sliver.
Ring_m turned_ring(const Geos& geos, const GEOSGeometry* linear_ring, bool counter_clockwise) {
  Ring_m ring = geos.ring_of(linear_ring);
  if (!(std::abs(signed_area_m2(ring)) > kSliver_m2)) return {};
  if (geos.is_counter_clockwise(linear_ring) != counter_clockwise)
    std::reverse(ring.begin(), ring.end());
  return ring;
}

Polygon_m rings_of(const Geos& geos, const GEOSGeometry* polygon) {
  GEOSContextHandle_t context = geos.context();
  Polygon_m rings_m = {turned_ring(geos, GEOSGetExteriorRing_r(context, polygon), true)};
  if (rings_m.front().empty()) return {};
  for (int i = 0; i < GEOSGetNumInteriorRings_r(context, polygon); ++i) {
    Ring_m hole = turned_ring(geos, GEOSGetInteriorRingN_r(context, polygon, i), false);
    if (!hole.empty()) rings_m.push_back(std::move(hole));
  }
  return rings_m;
}

// A repaired shape may be a collection with lines and points in it.
void collect_polygons(const Geos& geos, const GEOSGeometry* shape, std::vector<Polygon_m>& found) {
  GEOSContextHandle_t context = geos.context();
  const int type = GEOSGeomTypeId_r(context, shape);
  if (type == GEOS_POLYGON) {
    Polygon_m rings_m = rings_of(geos, shape);
    if (!rings_m.empty()) found.push_back(std::move(rings_m));
  } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
    for (int i = 0; i < GEOSGetNumGeometries_r(context, shape); ++i)
      collect_polygons(geos, GEOSGetGeometryN_r(context, shape, i), found);
  }
}

}  // namespace

double signed_area_m2(const Ring_m& ring) {
  double twice_m2 = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0];
    const glm::dvec2 b = ring[i + 1] - ring[0];
    twice_m2 += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice_m2;
}

std::vector<Polygon_m> clean_footprint(const Ring_m& outer_m, const std::vector<Ring_m>& holes_m) {
  const Geos geos;
  Polygon_m rings_m = {outer_m};
  rings_m.insert(rings_m.end(), holes_m.begin(), holes_m.end());
  Geos::Geometry shape = geos.polygon(rings_m);
  if (shape && GEOSisValid_r(geos.context(), shape.get()) != 1)
    shape = geos.own(GEOSMakeValid_r(geos.context(), shape.get()));
  std::vector<Polygon_m> polygons;
  if (shape) collect_polygons(geos, shape.get(), polygons);
  return polygons;
}

}  // namespace fanbeam::terrain
