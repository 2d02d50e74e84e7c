// What single frames, and a whole sequence, can see of a scene: the geometry behind its plans.
//
// A sequence sees what any of its frames sees. Frames are looked at one after the other until all
// that the scene has has been seen, from the last frame on: microseconds where that one sees it, up to
// two milliseconds a frame of a large scene that holds a thing that no frame sees. Heights stay those
// of the scene.
#pragma once

#include <functional>
#include <vector>

#include "renderer/frame_pose.h"
#include "renderer/plan/frame_facts.h"
#include "renderer/world.h"
#include "scenes/sight_map.h"

namespace fanbeam::scenes {

// `scene`: facts of all there is. Rain cells beside the fan count where rays that corners mirror, or
// those to a target beside it, may pass them.
renderer::FrameSight frame_sight(const renderer::SceneFacts& scene, const SightMap& map,
                                 const std::vector<renderer::PointTarget>& targets,
                                 const sensors::AntennaFrame& antenna, double time_s);

// `scene` narrowed to what the frames of a flight see. `pose_of` a frame is asked lazily.
renderer::SceneFacts sequence_facts(const renderer::SceneFacts& scene, const SightMap& map,
                                    const std::vector<renderer::PointTarget>& targets, int frames,
                                    const std::function<renderer::FramePose(int)>& pose_of);

}  // namespace fanbeam::scenes
