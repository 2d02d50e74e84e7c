// The scene's own frame: east-north-up axes at an origin near the airport, metres, double
// precision.
//
// Positions go through the WGS 84 ellipsoid (GeographicLib, Karney 2011: round trip below 1e-8 m),
// so the curvature of the Earth is in every vertex. A plane Earth is a separate kind of frame for
// scenes with closed-form answers.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/geodetic.h"

namespace fanbeam::terrain {

enum class EarthModel {
  wgs84,
  plane,  // x and y are metres of arc on the ellipsoid at the origin, z is the height difference; no curvature
};

class LocalFrame {
 public:
  // Throws InputError E-RANGE or E-NONFINITE as check_geodetic does.
  explicit LocalFrame(const core::Geodetic& origin, EarthModel model = EarthModel::wgs84);

  glm::dvec3 to_local_m(const core::Geodetic& position) const;
  core::Geodetic to_geodetic(const glm::dvec3& local_m) const;

  // Columns are the north, east and down unit vectors of `position` in this frame.
  glm::dmat3 north_east_down_at(const core::Geodetic& position) const;

  const core::Geodetic& origin() const { return origin_; }
  EarthModel model() const { return model_; }

 private:
  core::Geodetic origin_;
  EarthModel model_;
  glm::dvec3 origin_ecef_m_{0.0};
  glm::dmat3 ecef_from_local_{1.0};
  double metres_per_latitude_rad_ = 0.0;   // plane Earth only
  double metres_per_longitude_rad_ = 0.0;  // plane Earth only
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
