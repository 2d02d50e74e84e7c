// The scene's own frame: east-north-up axes at an origin near the airport, metres, double
// precision.
//
// Positions go through the WGS 84 ellipsoid (GeographicLib, Karney 2011: round trip below 1e-8 m),
// so the curvature of the Earth is in every vertex. How much the ground falls away depends on the
// place and the direction: the radius of curvature is 6335 km along the meridian at the equator and
// 6400 km at the poles (docs/physics/earth.md).
//
// A plane Earth is a separate kind of frame for scenes with closed-form answers: the azimuthal
// equidistant map about the origin (Snyder, USGS Professional Paper 1395, 1987, section 25; here by
// geodesics of the ellipsoid). Distance and direction from the origin are those of the geodesic at
// height 0, z is the difference of heights. It has no special place: poles and the date line are
// like any other. Lengths across that direction are wrong by (d / R)^2 / 6 at a distance d, 6e-8 at
// 3.7 km; d up to the other side of the Earth is allowed and means less and less.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/geodetic.h"

namespace fanbeam::terrain {

enum class EarthModel {
  wgs84,
  plane,
};

class LocalFrame {
 public:
  // Throws InputError E-RANGE or E-NONFINITE as check_geodetic does.
  explicit LocalFrame(const core::Geodetic& origin, EarthModel model = EarthModel::wgs84);

  glm::dvec3 to_local_m(const core::Geodetic& position) const;
  core::Geodetic to_geodetic(const glm::dvec3& local_m) const;

  // Columns are the north, east and down unit vectors of `position` in this frame. On a plane Earth
  // down is the same everywhere; north turns with the meridians, as on the map.
  glm::dmat3 north_east_down_at(const core::Geodetic& position) const;

  const core::Geodetic& origin() const { return origin_; }
  EarthModel model() const { return model_; }

 private:
  core::Geodetic origin_;
  EarthModel model_;
  glm::dvec3 origin_ecef_m_{0.0};    // of wgs84
  glm::dmat3 ecef_from_local_{1.0};  // of wgs84
};

// Earth-centred, Earth-fixed coordinates on WGS 84.
glm::dvec3 ecef_from_geodetic(const core::Geodetic& position);
core::Geodetic geodetic_from_ecef(const glm::dvec3& ecef_m);

// Throws InputError: E-NONFINITE, or E-RANGE outside latitude +-90 deg, longitude +-540 deg, height
// -20 km to 1000 km. `field` begins the name in the message.
void check_geodetic(const core::Geodetic& position, const char* field);

// Length of the geodesic and azimuth (clockwise from north) at its start, on WGS 84 at height 0.
struct GeodesicLine {
  double length_m = 0.0;
  double azimuth_rad = 0.0;
};
GeodesicLine geodesic_between(const core::Geodetic& from, const core::Geodetic& to);
// The point `distance_m` from `from` along `azimuth_rad`; its height is that of `from`.
core::Geodetic geodesic_point(const core::Geodetic& from, double azimuth_rad, double distance_m);

}  // namespace fanbeam::terrain
