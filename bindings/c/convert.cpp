#include "bindings/c/convert.h"

namespace fanbeam::bindings {

core::Pose pose_of(const fanbeam_pose& pose) {
  core::Pose result;
  result.time_s = pose.time_s;
  result.position = {pose.latitude_rad, pose.longitude_rad, pose.height_m};
  result.q_NB = core::quaternion_from({pose.roll_rad, pose.pitch_rad, pose.heading_rad});
  result.v_N_mps = glm::dvec3(pose.north_mps, pose.east_mps, pose.down_mps);
  return result;
}

fanbeam_pose pose_of(const core::Pose& pose) {
  const core::Attitude attitude = core::attitude_from(pose.q_NB);
  fanbeam_pose result{};
  result.size = sizeof result;
  result.time_s = pose.time_s;
  result.latitude_rad = pose.position.latitude_rad;
  result.longitude_rad = pose.position.longitude_rad;
  result.height_m = pose.position.height_m;
  result.roll_rad = attitude.roll_rad;
  result.pitch_rad = attitude.pitch_rad;
  result.heading_rad = attitude.heading_rad;
  result.north_mps = pose.v_N_mps.x;
  result.east_mps = pose.v_N_mps.y;
  result.down_mps = pose.v_N_mps.z;
  return result;
}

Shape shape_of(const sensors::Sensor& sensor) {
  return {static_cast<std::size_t>(sensor.scan.columns),
          static_cast<std::size_t>(sensor.range.cells),
          static_cast<std::size_t>(sensor.display.cscope_rows)};
}

std::uint32_t events_of(const std::vector<std::string>& events) {
  std::uint32_t bits = 0;
  for (const std::string& event : events) {
    if (event == "outside_volume") bits |= FANBEAM_OUTSIDE_VOLUME;
    if (event == "below_terrain") bits |= FANBEAM_BELOW_TERRAIN;
    if (event == "empty_view") bits |= FANBEAM_EMPTY_VIEW;
  }
  return bits;
}

}  // namespace fanbeam::bindings
