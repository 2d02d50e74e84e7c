#include "scenes/scene_pose.h"

namespace fanbeam::scenes {

renderer::FramePose pose_in(const terrain::LocalFrame& frame, const core::Pose& pose) {
  return {.time_s = pose.time_s,
          .position_m = frame.to_local_m(pose.position),
          .north_east_down = frame.north_east_down_at(pose.position),
          .q_NB = pose.q_NB};
}

renderer::FramePose frame_pose(const terrain::LocalFrame& frame, const Trajectory& trajectory,
                               const sensors::Sensor& sensor, int frame_index) {
  renderer::FramePose pose = pose_in(
      frame, trajectory.at(trajectory.frame_time_s(frame_index, sensor.scan.frame_rate_Hz)));
  pose.frame_index = static_cast<std::uint64_t>(frame_index);
  return pose;
}

}  // namespace fanbeam::scenes
