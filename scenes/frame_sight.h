// What single frames, and a whole sequence, can see of a scene: the geometry behind its plans.
//
// A sequence sees what any of its frames sees. Frames are looked at one after the other until all
// that the scene has has been seen: microseconds where the first frame sees it, up to a millisecond
// a frame of a large scene that holds a thing that no frame sees. Heights stay those of the scene.
#pragma once

#include <vector>

#include "renderer/frame_pose.h"
#include "renderer/plan/frame_facts.h"
#include "renderer/world.h"
#include "scenes/plan_facts.h"
#include "scenes/sight_map.h"

namespace fanbeam::scenes {

// `scene`: facts of all there is. Rain cells beside the fan count where mirrored rays may pass them.
renderer::FrameSight frame_sight(const renderer::SceneFacts& scene, const SightMap& map,
                                 const std::vector<renderer::PointTarget>& targets,
                                 const sensors::AntennaFrame& antenna, double time_s);

// `scene` narrowed to what the flight of `parts` sees.
renderer::SceneFacts sequence_facts(const SceneParts& parts, const renderer::SceneFacts& scene,
                                    const SightMap& map);

}  // namespace fanbeam::scenes
