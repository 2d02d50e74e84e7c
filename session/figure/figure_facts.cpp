#include "session/figure/figure_facts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::session {
namespace {

constexpr double kNauticalMile_m = 1852.0;  // international, exact
constexpr double kShortRange_m = 2000.0;

std::string angle_text(double angle_deg, const char* positive, const char* negative, int digits) {
  return fmt::format("{:0{}.5f}\u00b0 {}", std::abs(angle_deg), digits,
                     angle_deg < 0.0 ? negative : positive);
}

// Without the sign of what rounds to zero.
std::string signed_deg(double angle_rad) {
  const double tenths = std::round(core::degrees(angle_rad) * 10.0);
  return tenths == 0.0 ? "0.0\u00b0" : fmt::format("{:+.1f}\u00b0", tenths / 10.0);
}

std::string heading_text(double heading_rad) {
  const double tenths = std::fmod(std::round(core::degrees(heading_rad) * 10.0), 3600.0);
  return fmt::format("{:05.1f}\u00b0 true", tenths / 10.0);
}

std::string height_text(double height_m, core::VerticalDatum datum) {
  return fmt::format("{:.1f} m, {:.0f} ft {}", height_m, height_m / core::kFoot_m,
                     datum == core::VerticalDatum::scene ? "(scene's datum)" : "(ellipsoid)");
}

// Where a direction of this azimuth is level; elevation grows along it from nadir to zenith.
double horizon_rad(const sensors::AntennaFrame& antenna, const glm::dvec3& up, double azimuth_rad,
                   sensors::ScanSurface surface) {
  double low_rad = -core::kPi / 2, high_rad = core::kPi / 2;
  for (int i = 0; i < 50; ++i) {
    const double middle_rad = 0.5 * (low_rad + high_rad);
    const glm::dvec3 ray = sensors::direction(antenna, azimuth_rad, middle_rad, surface);
    (glm::dot(ray, up) < 0.0 ? low_rad : high_rad) = middle_rad;
  }
  return 0.5 * (low_rad + high_rad);
}

}  // namespace

RangeUnit range_unit(const std::string& wish, const sensors::RangeGate& gate) {
  if (wish == "NM") return {"NM", kNauticalMile_m};
  if (wish == "km" || (wish != "m" && gate.maximum_m() > kShortRange_m)) return {"km", 1000.0};
  return {"m", 1.0};
}

std::string length_text(double length_m, const RangeUnit& unit) {
  const double length = length_m / unit.metres;
  const int decimals = length < 9.995 ? 2 : length < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", length, decimals, unit.name);
}

FigureFacts figure_facts(const scenes::Scene& scene, const core::Pose& pose, int frame,
                         const std::string& unit_wish) {
  const scenes::SceneDescription& description = scene.description;
  const sensors::Sensor& sensor = description.sensor;
  const renderer::FramePose frame_pose = scene.pose_at(pose);
  const sensors::AntennaFrame antenna = renderer::antenna_of(sensor, frame_pose);
  const core::Attitude attitude = core::attitude_from(pose.q_NB);
  const double speed_mps = glm::length(pose.v_N_mps);

  FigureFacts facts;
  facts.title = description.title.empty() ? description.name : description.title;
  facts.scene = description.name;
  facts.sensor = fmt::format("{}, {} GHz {}", sensor.name,
                             core::number_text(sensor.waveform.frequency_Hz / 1e9),
                             core::name_of(sensor.waveform.polarisation));
  facts.frame = fmt::format("{:05}", frame);
  facts.time = fmt::format("{:.3f} s", pose.time_s);
  facts.position =
      angle_text(core::degrees(pose.position.latitude_rad), "N", "S", 8) + "  " +
      angle_text(core::degrees(core::wrap_pi_rad(pose.position.longitude_rad)), "E", "W", 9);
  facts.height = height_text(pose.position.height_m, description.datum);
  facts.speed = fmt::format("{:.1f} m/s, {:.0f} kt", speed_mps, speed_mps / core::kKnot_mps);
  facts.heading = heading_text(attitude.heading_rad);
  facts.pitch = signed_deg(attitude.pitch_rad);
  facts.roll = signed_deg(attitude.roll_rad);
  facts.unit = range_unit(unit_wish, sensor.range);
  facts.aircraft = sensor.range.maximum_m() > kShortRange_m;
  const glm::dvec3 up = -frame_pose.north_east_down[2];
  facts.runways = runway_views(scene.runways, sensor, antenna, up);
  const double half_rad = 0.5 * sensor.scan.field_of_view_rad;
  facts.horizon_left_rad = horizon_rad(antenna, up, -half_rad, sensor.scan.surface);
  facts.horizon_right_rad = horizon_rad(antenna, up, half_rad, sensor.scan.surface);
  const glm::dvec3 ahead =
      sensors::direction(antenna, 0.0, sensor.antenna.boresight_elevation_rad, sensor.scan.surface);
  facts.boresight_above_level_rad = std::asin(std::clamp(glm::dot(ahead, up), -1.0, 1.0));
  return facts;
}

}  // namespace fanbeam::session
