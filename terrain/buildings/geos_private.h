// Polygons to GEOS and back.
#pragma once

#include <geos_c.h>

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/buildings/clean_footprint.h"

namespace fanbeam::terrain {

// One GEOS context; not for two threads at once. Geometries must not outlive it. GEOS reports what
// it cannot do by null, and prints nothing.
class Geos {
 public:
  struct GeometryDeleter {
    GEOSContextHandle_t context = nullptr;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, GeometryDeleter>;

  Geos() : context_(GEOS_init_r()) {}

  GEOSContextHandle_t context() const { return context_.get(); }
  Geometry own(GEOSGeometry* geometry) const {
    return Geometry(geometry, GeometryDeleter{context()});
  }
  // Rings as they are, valid or not; the first needs three points, shorter ones behind it are left
  // out.
  Geometry polygon(const Polygon_m& rings_m) const;
  // Without the closing point and without repeated points.
  Ring_m ring_of(const GEOSGeometry* linear_ring) const;
  // Without further vertices (constrained Delaunay), counter-clockwise; indices of points count through all
  // rings, one after the other. Nothing where GEOS cannot.
  std::optional<std::vector<glm::uvec3>> triangulate(const Polygon_m& rings_m) const;
  // Of a simple ring; by exact signs, so that thin ones far from the origin are right as well.
  bool is_counter_clockwise(const GEOSGeometry* linear_ring) const;

 private:
  struct ContextDeleter {
    void operator()(GEOSContextHandle_t context) const { GEOS_finish_r(context); }
  };

  Geometry linear_ring(const Ring_m& ring) const;

  std::unique_ptr<GEOSContextHandle_HS, ContextDeleter> context_;
};

}  // namespace fanbeam::terrain
