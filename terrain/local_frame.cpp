#include "terrain/local_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
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

// Where a place lies on a plane Earth about `origin`, and which way is north there. Angles in
// degrees, so that what lies due east, south or west does so exactly.
struct PlanePlace {
  double distance_m = 0.0;
  double azimuth_deg = 0.0;      // at the origin, of the geodesic to the place
  double end_azimuth_deg = 0.0;  // of the same at the place
};

PlanePlace plane_place(const core::Geodetic& origin, const core::Geodetic& position) {
  PlanePlace place;
  GeographicLib::Geodesic::WGS84().Inverse(
      core::degrees(origin.latitude_rad), core::degrees(origin.longitude_rad),
      core::degrees(position.latitude_rad), core::degrees(position.longitude_rad), place.distance_m,
      place.azimuth_deg, place.end_azimuth_deg);
  return place;
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
  if (model == EarthModel::plane) return;
  const EcefFrame frame = ecef_frame_at(origin);
  origin_ecef_m_ = frame.position_m;
  ecef_from_local_ = frame.ecef_from_east_north_up;
}

glm::dvec3 LocalFrame::to_local_m(const core::Geodetic& position) const {
  if (model_ == EarthModel::plane) {
    const PlanePlace place = plane_place(origin_, position);
    double sine = 0.0;
    double cosine = 0.0;
    GeographicLib::Math::sincosd(place.azimuth_deg, sine, cosine);
    return {place.distance_m * sine, place.distance_m * cosine,
            position.height_m - origin_.height_m};
  }
  return glm::transpose(ecef_from_local_) * (ecef_from_geodetic(position) - origin_ecef_m_);
}

core::Geodetic LocalFrame::to_geodetic(const glm::dvec3& local_m) const {
  if (model_ == EarthModel::plane) {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    GeographicLib::Geodesic::WGS84().Direct(
        core::degrees(origin_.latitude_rad), core::degrees(origin_.longitude_rad),
        GeographicLib::Math::atan2d(local_m.x, local_m.y), std::hypot(local_m.x, local_m.y),
        latitude_deg, longitude_deg);
    return {core::radians(latitude_deg), core::radians(longitude_deg),
            origin_.height_m + local_m.z};
  }
  return geodetic_from_ecef(origin_ecef_m_ + ecef_from_local_ * local_m);
}

glm::dmat3 LocalFrame::north_east_down_at(const core::Geodetic& position) const {
  if (model_ == EarthModel::plane) {
    const PlanePlace place = plane_place(origin_, position);
    double sine = 0.0;
    double cosine = 0.0;
    GeographicLib::Math::sincosd(place.azimuth_deg - place.end_azimuth_deg, sine, cosine);
    return {{sine, cosine, 0.0}, {cosine, -sine, 0.0}, {0.0, 0.0, -1.0}};
  }
  const glm::dmat3 local_from_east_north_up =
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
