#include "terrain/local_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <glm/matrix.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::terrain {
namespace {

constexpr double kLowestHeight_m = -20.0e3;
constexpr double kHighestHeight_m = 1.0e6;
// A plane Earth divides by the cosine of this latitude.
constexpr double kLargestPlaneLatitude_rad = core::radians(89.0);

struct EcefFrame {
  glm::dvec3 position_m{0.0};
  glm::dmat3 ecef_from_east_north_up{1.0};
};

EcefFrame ecef_frame_at(const core::Geodetic& position) {
  EcefFrame frame;
  std::vector<double> rows(9);
  GeographicLib::Geocentric::WGS84().Forward(
      core::degrees(position.latitude_rad), core::degrees(position.longitude_rad),
      position.height_m, frame.position_m.x, frame.position_m.y, frame.position_m.z, rows);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      frame.ecef_from_east_north_up[column][row] = rows[static_cast<std::size_t>(3 * row + column)];
  return frame;
}

struct RadiiOfCurvature {
  double meridian_m = 0.0;
  double prime_vertical_m = 0.0;
};

RadiiOfCurvature radii_at(double latitude_rad) {
  const auto& ellipsoid = GeographicLib::Geocentric::WGS84();
  const double f = ellipsoid.Flattening();
  const double e2 = f * (2.0 - f);
  const double sine = std::sin(latitude_rad);
  const double w2 = 1.0 - e2 * sine * sine;
  const double prime_vertical_m = ellipsoid.EquatorialRadius() / std::sqrt(w2);
  return {prime_vertical_m * (1.0 - e2) / w2, prime_vertical_m};
}

void check_coordinate(core::ProblemList& problems, const std::string& field, double value,
                      double lowest, double highest, const char* expected) {
  if (!std::isfinite(value)) {
    problems.error(core::ErrorClass::nonfinite, {}, field, core::number_text(value), expected);
  } else if (value < lowest || value > highest) {
    problems.error(core::ErrorClass::range, {}, field, core::number_text(value), expected);
  }
}

}  // namespace

LocalFrame::LocalFrame(const core::Geodetic& origin, EarthModel model)
    : origin_(origin), model_(model) {
  check_geodetic(origin, "origin");
  if (model == EarthModel::wgs84) {
    const EcefFrame frame = ecef_frame_at(origin);
    origin_ecef_m_ = frame.position_m;
    ecef_from_local_ = frame.ecef_from_east_north_up;
    return;
  }
  if (std::abs(origin.latitude_rad) > kLargestPlaneLatitude_rad)
    core::throw_input_error(core::ErrorClass::range, "origin.latitude_deg",
                            core::degrees(origin.latitude_rad), "-89 to 89 on a plane Earth");
  const RadiiOfCurvature radii = radii_at(origin.latitude_rad);
  metres_per_latitude_rad_ = radii.meridian_m;
  metres_per_longitude_rad_ = radii.prime_vertical_m * std::cos(origin.latitude_rad);
}

glm::dvec3 LocalFrame::to_local_m(const core::Geodetic& position) const {
  if (model_ == EarthModel::plane) {
    const double longitude_rad = core::wrap_pi_rad(position.longitude_rad - origin_.longitude_rad);
    return {longitude_rad * metres_per_longitude_rad_,
            (position.latitude_rad - origin_.latitude_rad) * metres_per_latitude_rad_,
            position.height_m - origin_.height_m};
  }
  return glm::transpose(ecef_from_local_) * (ecef_from_geodetic(position) - origin_ecef_m_);
}

core::Geodetic LocalFrame::to_geodetic(const glm::dvec3& local_m) const {
  if (model_ == EarthModel::plane)
    return {origin_.latitude_rad + local_m.y / metres_per_latitude_rad_,
            core::wrap_pi_rad(origin_.longitude_rad + local_m.x / metres_per_longitude_rad_),
            origin_.height_m + local_m.z};
  return geodetic_from_ecef(origin_ecef_m_ + ecef_from_local_ * local_m);
}

glm::dmat3 LocalFrame::north_east_down_at(const core::Geodetic& position) const {
  glm::dmat3 local_from_east_north_up{1.0};
  if (model_ == EarthModel::wgs84)
    local_from_east_north_up =
        glm::transpose(ecef_from_local_) * ecef_frame_at(position).ecef_from_east_north_up;
  return {local_from_east_north_up[1], local_from_east_north_up[0], -local_from_east_north_up[2]};
}

glm::dvec3 ecef_from_geodetic(const core::Geodetic& position) {
  glm::dvec3 ecef_m{0.0};
  GeographicLib::Geocentric::WGS84().Forward(core::degrees(position.latitude_rad),
                                             core::degrees(position.longitude_rad),
                                             position.height_m, ecef_m.x, ecef_m.y, ecef_m.z);
  return ecef_m;
}

core::Geodetic geodetic_from_ecef(const glm::dvec3& ecef_m) {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  GeographicLib::Geocentric::WGS84().Reverse(ecef_m.x, ecef_m.y, ecef_m.z, latitude_deg,
                                             longitude_deg, height_m);
  return {core::radians(latitude_deg), core::radians(longitude_deg), height_m};
}

void check_geodetic(const core::Geodetic& position, const char* field) {
  core::ProblemList problems;
  const std::string name = field;
  check_coordinate(problems, name + ".latitude_deg", core::degrees(position.latitude_rad), -90.0,
                   90.0, "-90 to 90 deg");
  check_coordinate(problems, name + ".longitude_deg", core::degrees(position.longitude_rad), -540.0,
                   540.0, "-540 to 540 deg");
  check_coordinate(problems, name + ".height_m", position.height_m, kLowestHeight_m,
                   kHighestHeight_m, "-20000 to 1000000 m");
  problems.throw_if_errors();
}

GeodesicLine geodesic_between(const core::Geodetic& from, const core::Geodetic& to) {
  double length_m = 0.0;
  double azimuth_deg = 0.0;
  double azimuth_at_end_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(
      core::degrees(from.latitude_rad), core::degrees(from.longitude_rad),
      core::degrees(to.latitude_rad), core::degrees(to.longitude_rad), length_m, azimuth_deg,
      azimuth_at_end_deg);
  return {length_m, core::radians(azimuth_deg)};
}

core::Geodetic geodesic_point(const core::Geodetic& from, double azimuth_rad, double distance_m) {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Direct(
      core::degrees(from.latitude_rad), core::degrees(from.longitude_rad),
      core::degrees(azimuth_rad), distance_m, latitude_deg, longitude_deg);
  return {core::radians(latitude_deg), core::radians(longitude_deg), from.height_m};
}

}  // namespace fanbeam::terrain
