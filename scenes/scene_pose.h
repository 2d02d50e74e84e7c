// Where the aircraft is in the scene.
#pragma once

#include "renderer/frame_pose.h"
#include "scenes/trajectory/trajectory.h"
#include "sensors/sensor.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

renderer::FramePose pose_in(const terrain::LocalFrame& frame, const core::Pose& pose);

// In the middle of a frame.
renderer::FramePose frame_pose(const terrain::LocalFrame& frame, const Trajectory& trajectory,
                               const sensors::Sensor& sensor, int frame_index);

}  // namespace fanbeam::scenes
