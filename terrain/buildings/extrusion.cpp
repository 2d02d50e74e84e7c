#include "terrain/buildings/extrusion.h"

#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace fanbeam::terrain {
namespace {

struct ContextDeleter {
  void operator()(GEOSContextHandle_t context) const { GEOS_finish_r(context); }
};
using Context = std::unique_ptr<GEOSContextHandle_HS, ContextDeleter>;

struct GeometryDeleter {
  GEOSContextHandle_t context = nullptr;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using Geometry = std::unique_ptr<GEOSGeometry, GeometryDeleter>;

double twice_signed_area_m2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double signed_area_m2(const Ring_m& ring) {
  double twice_m2 = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice_m2 += twice_signed_area_m2(ring[0], ring[i], ring[i + 1]);
  return 0.5 * twice_m2;
}

// Puts prisms into one mesh, one after the other.
class Extruder {
 public:
  Extruder(const std::string& name, const ExtrusionMaterials& materials) : context_(GEOS_init_r()) {
    result_.mesh.name = name;
    result_.mesh.material_names = {materials.wall, materials.roof};
  }

  enum class Outcome { done, degenerate, not_triangulated };
  // Leaves the mesh as it was unless the outcome is `done`.
  Outcome add(const Prism& prism, std::uint32_t index);
  Extrusion take() { return std::move(result_); }

 private:
  // Indices of the roof's corners by position, for one polygon.
  using Corners = std::map<std::pair<double, double>, std::uint32_t>;

  Geometry own(GEOSGeometry* geometry) const {
    return Geometry(geometry, GeometryDeleter{context_.get()});
  }
  Geometry linear_ring(const Ring_m& ring) const;
  Geometry polygon(const Prism& prism) const;
  Ring_m ring_of(const GEOSGeometry* linear_ring) const;
  bool add_polygons(const GEOSGeometry* shape, const Prism& prism);
  bool add_polygon(const GEOSGeometry* polygon, const Prism& prism);
  bool add_roof(const GEOSGeometry* triangles, const Corners& corners);
  void add_walls(Ring_m ring, bool counter_clockwise, const Prism& prism, Corners& corners);
  void add_triangle(const glm::uvec3& triangle, std::uint32_t slot);

  Context context_;
  Extrusion result_;
  std::uint32_t prism_index_ = 0;
};

Geometry Extruder::linear_ring(const Ring_m& ring) const {
  GEOSContextHandle_t context = context_.get();
  const auto count = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* points = GEOSCoordSeq_create_r(context, count + 1, 2);
  for (unsigned i = 0; i <= count; ++i)
    GEOSCoordSeq_setXY_r(context, points, i, ring[i % count].x, ring[i % count].y);
  return own(GEOSGeom_createLinearRing_r(context, points));
}

// Nothing when a ring has too few points.
Geometry Extruder::polygon(const Prism& prism) const {
  if (prism.outer_m.size() < 3) return own(nullptr);
  Geometry outer = linear_ring(prism.outer_m);
  std::vector<Geometry> holes;
  for (const Ring_m& hole : prism.holes_m)
    if (hole.size() >= 3) holes.push_back(linear_ring(hole));
  std::vector<GEOSGeometry*> hole_pointers;
  hole_pointers.reserve(holes.size());
  for (Geometry& hole : holes) hole_pointers.push_back(hole.release());
  return own(GEOSGeom_createPolygon_r(context_.get(), outer.release(), hole_pointers.data(),
                                      static_cast<unsigned>(hole_pointers.size())));
}

Ring_m Extruder::ring_of(const GEOSGeometry* linear_ring) const {
  GEOSContextHandle_t context = context_.get();
  const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(context, linear_ring);
  unsigned count = 0;
  GEOSCoordSeq_getSize_r(context, points, &count);
  Ring_m ring;
  for (unsigned i = 0; i + 1 < count; ++i) {
    glm::dvec2 point{0.0};
    GEOSCoordSeq_getXY_r(context, points, i, &point.x, &point.y);
    if (ring.empty() || point != ring.back()) ring.push_back(point);
  }
  return ring;
}

Extruder::Outcome Extruder::add(const Prism& prism, std::uint32_t index) {
  prism_index_ = index;
  if (!(prism.top_m > prism.bottom_m)) return Outcome::degenerate;
  GEOSContextHandle_t context = context_.get();
  Geometry shape = polygon(prism);
  if (shape && GEOSisValid_r(context, shape.get()) != 1)
    shape = own(GEOSMakeValid_r(context, shape.get()));
  double area_m2 = 0.0;
  if (!shape || GEOSArea_r(context, shape.get(), &area_m2) != 1 || !(area_m2 > 0.0))
    return Outcome::degenerate;
  const std::size_t vertices = result_.mesh.vertices_m.size();
  const std::size_t triangles = result_.mesh.triangles.size();
  if (add_polygons(shape.get(), prism)) return Outcome::done;
  result_.mesh.vertices_m.resize(vertices);
  result_.mesh.triangles.resize(triangles);
  result_.mesh.triangle_material.resize(triangles);
  result_.triangle_prism.resize(triangles);
  return Outcome::not_triangulated;
}

// A repaired shape may be a collection with lines and points in it.
bool Extruder::add_polygons(const GEOSGeometry* shape, const Prism& prism) {
  GEOSContextHandle_t context = context_.get();
  for (int i = 0; i < GEOSGetNumGeometries_r(context, shape); ++i) {
    const GEOSGeometry* part = GEOSGetGeometryN_r(context, shape, i);
    for (int j = 0; j < GEOSGetNumGeometries_r(context, part); ++j) {
      const GEOSGeometry* single = GEOSGetGeometryN_r(context, part, j);
      if (GEOSGeomTypeId_r(context, single) == GEOS_POLYGON && !add_polygon(single, prism))
        return false;
    }
  }
  return true;
}

bool Extruder::add_polygon(const GEOSGeometry* polygon, const Prism& prism) {
  GEOSContextHandle_t context = context_.get();
  const Geometry triangles = own(GEOSConstrainedDelaunayTriangulation_r(context, polygon));
  if (!triangles) return false;
  Corners corners;
  add_walls(ring_of(GEOSGetExteriorRing_r(context, polygon)), true, prism, corners);
  for (int i = 0; i < GEOSGetNumInteriorRings_r(context, polygon); ++i)
    add_walls(ring_of(GEOSGetInteriorRingN_r(context, polygon, i)), false, prism, corners);
  return add_roof(triangles.get(), corners);
}

// Walking a ring with the building on the left, the outside is on the right.
void Extruder::add_walls(Ring_m ring, bool counter_clockwise, const Prism& prism,
                         Corners& corners) {
  if ((signed_area_m2(ring) > 0.0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  std::vector<glm::dvec3>& vertices = result_.mesh.vertices_m;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    corners[{ring[i].x, ring[i].y}] = first + 2 * i + 1;
    vertices.emplace_back(ring[i].x, ring[i].y, prism.bottom_m);
    vertices.emplace_back(ring[i].x, ring[i].y, prism.top_m);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = first + 2 * i;
    const std::uint32_t next = first + 2 * ((i + 1) % count);
    add_triangle({here, next, next + 1}, kWallSlot);
    add_triangle({here, next + 1, here + 1}, kWallSlot);
  }
}

bool Extruder::add_roof(const GEOSGeometry* triangles, const Corners& corners) {
  GEOSContextHandle_t context = context_.get();
  for (int i = 0; i < GEOSGetNumGeometries_r(context, triangles); ++i) {
    const GEOSGeometry* triangle = GEOSGetGeometryN_r(context, triangles, i);
    Ring_m points = ring_of(GEOSGetExteriorRing_r(context, triangle));
    if (points.size() != 3) return false;
    if (twice_signed_area_m2(points[0], points[1], points[2]) < 0.0)
      std::swap(points[1], points[2]);
    glm::uvec3 indices{0};
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2& point = points[static_cast<std::size_t>(k)];
      const auto corner = corners.find({point.x, point.y});
      if (corner == corners.end()) return false;
      indices[k] = corner->second;
    }
    add_triangle(indices, kRoofSlot);
  }
  return true;
}

void Extruder::add_triangle(const glm::uvec3& triangle, std::uint32_t slot) {
  result_.mesh.triangles.push_back(triangle);
  result_.mesh.triangle_material.push_back(slot);
  result_.triangle_prism.push_back(prism_index_);
}

// An error and false when a coordinate cannot be used.
bool check_coordinates(const Prism& prism, std::size_t index, const std::string& name,
                       core::ProblemList& problems) {
  std::vector<double> numbers = {prism.bottom_m, prism.top_m};
  const auto collect = [&numbers](const Ring_m& ring) {
    for (const glm::dvec2& point : ring) numbers.insert(numbers.end(), {point.x, point.y});
  };
  collect(prism.outer_m);
  std::for_each(prism.holes_m.begin(), prism.holes_m.end(), collect);
  for (const double number : numbers) {
    const bool finite = std::isfinite(number);
    if (finite && std::abs(number) <= kLargestCoordinate_m) continue;
    problems.error(finite ? core::ErrorClass::range : core::ErrorClass::nonfinite, {},
                   name + " building " + std::to_string(index), core::number_text(number),
                   "coordinates of -1000 to 1000 km");
    return false;
  }
  return true;
}

}  // namespace

Extrusion extrude(const std::vector<Prism>& prisms, const std::string& name,
                  const ExtrusionMaterials& materials, core::ProblemList& problems) {
  Extruder extruder(name, materials);
  std::size_t degenerate = 0;
  std::size_t not_triangulated = 0;
  for (std::size_t i = 0; i < prisms.size(); ++i) {
    if (!check_coordinates(prisms[i], i, name, problems)) continue;
    const auto outcome = extruder.add(prisms[i], static_cast<std::uint32_t>(i));
    if (outcome == Extruder::Outcome::degenerate) ++degenerate;
    if (outcome == Extruder::Outcome::not_triangulated) ++not_triangulated;
  }
  const auto report = [&](const char* warning, std::size_t count, const char* reason) {
    if (count > 0)
      problems.warning(warning, {}, name + " buildings " + reason, std::to_string(count),
                       "left out");
  };
  report("DEGENERATE", degenerate, "without area or height");
  report("SKIPPED", not_triangulated, "whose roof cannot be triangulated");
  Extrusion result = extruder.take();
  result.failed = degenerate + not_triangulated;
  return result;
}

}  // namespace fanbeam::terrain
