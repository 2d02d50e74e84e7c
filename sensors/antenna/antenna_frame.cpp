#include "sensors/antenna/antenna_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/errors.h"
#include "core/pose.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/antenna/column_place.h"

namespace fanbeam::sensors {
namespace {

// Components along forward, right and up.
glm::dvec3 components(const AntennaFrame& frame, const glm::dvec3& v) {
  return {glm::dot(v, frame.forward), glm::dot(v, frame.right), glm::dot(v, frame.up)};
}

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

AntennaAngles plane_angles(const glm::dvec3& fru) {
  return {std::atan2(fru.y, fru.x), std::atan2(fru.z, std::hypot(fru.x, fru.y))};
}

}  // namespace

AntennaFrame antenna_frame(const glm::dvec3& aircraft_position_m, const glm::dmat3& R_SN,
                           const glm::dquat& q_NB, const Mounting& mounting, bool stabilised) {
  if (!finite(aircraft_position_m))
    core::throw_input_error(core::ErrorClass::nonfinite, "aircraft position", "not finite",
                            "three finite numbers, m");
  const core::Attitude attitude = core::attitude_from(q_NB);
  const glm::dmat3 R_NB = glm::mat3_cast(core::quaternion_from(attitude));

  AntennaFrame frame;
  const glm::dvec3 lever_m(mounting.forward_m, mounting.right_m, mounting.down_m);
  frame.position_m = aircraft_position_m + R_SN * (R_NB * lever_m);

  glm::dmat3 R_NA;
  if (stabilised) {
    const double heading_rad = attitude.heading_rad + mounting.yaw_rad;
    R_NA = glm::mat3_cast(core::quaternion_from({0.0, 0.0, heading_rad}));
  } else {
    const core::Attitude mounted{mounting.roll_rad, mounting.pitch_rad, mounting.yaw_rad};
    R_NA = R_NB * glm::mat3_cast(core::quaternion_from(mounted));
  }
  frame.forward = R_SN * R_NA[0];
  frame.right = R_SN * R_NA[1];
  frame.up = -(R_SN * R_NA[2]);
  return frame;
}

glm::dvec3 direction(const AntennaFrame& frame, double azimuth_rad, double elevation_rad,
                     ScanSurface surface) {
  const double ca = std::cos(azimuth_rad), sa = std::sin(azimuth_rad);
  const double ce = std::cos(elevation_rad), se = std::sin(elevation_rad);
  if (surface == ScanSurface::cone)
    return ca * ce * frame.forward + sa * frame.right + ca * se * frame.up;
  return ce * ca * frame.forward + ce * sa * frame.right + se * frame.up;
}

std::optional<AntennaAngles> angles(const AntennaFrame& frame, const glm::dvec3& from_antenna_m,
                                    ScanSurface surface) {
  const glm::dvec3 fru = components(frame, from_antenna_m);
  if (!finite(fru) || !(fru.x > 0.0)) return std::nullopt;
  if (surface == ScanSurface::plane) return plane_angles(fru);
  return AntennaAngles{std::atan2(fru.y, std::hypot(fru.x, fru.z)), std::atan2(fru.z, fru.x)};
}

std::optional<AntennaAngles> all_round_angles(const AntennaFrame& frame,
                                              const glm::dvec3& from_antenna_m) {
  const glm::dvec3 fru = components(frame, from_antenna_m);
  if (!finite(fru) || fru == glm::dvec3(0.0)) return std::nullopt;
  return plane_angles(fru);
}

HeightSpan heights_in_beam(const AntennaFrame& frame, const Sensor& sensor) {
  const double tilt_rad = std::acos(std::clamp(frame.up.z, -1.0, 1.0));
  const double aside_rad = reach_rad(sensor.antenna.elevation) + tilt_rad;
  const double boresight_rad = sensor.antenna.boresight_elevation_rad;
  const auto farthest_m = [&](double elevation_rad) {
    return frame.position_m.z +
           sensor.range.maximum_m() *
               std::sin(std::clamp(elevation_rad, -core::kPi / 2, core::kPi / 2));
  };
  return {std::min(frame.position_m.z, farthest_m(boresight_rad - aside_rad)),
          std::max(frame.position_m.z, farthest_m(boresight_rad + aside_rad))};
}

bool beams_reach_behind(const Sensor& sensor) {
  return sensor.scan.surface == ScanSurface::plane &&
         sensor.scan.field_of_view_rad / 2 + azimuth_reach_rad(sensor, steepest_rad(sensor)) >
             core::kPi / 2;
}

std::optional<AntennaAngles> angles(const AntennaFrame& frame, const glm::dvec3& from_antenna_m,
                                    const Sensor& sensor) {
  return beams_reach_behind(sensor) ? all_round_angles(frame, from_antenna_m)
                                    : angles(frame, from_antenna_m, sensor.scan.surface);
}

}  // namespace fanbeam::sensors
