// What one frame, or the frames of a sequence together, can see of a scene, and the scene's facts
// narrowed to that.
//
// Conservative: whoever fills in FrameSight may name more than is seen, never less. Then every bound
// of the effect catalogue that uses the narrowed facts is a bound for what sees so much, and at most
// that of the facts before. What FrameSight does not name stays: the
// materials, their state, the sensor, and the echoing area of the targets while any is in view.
#pragma once

#include <vector>

#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

struct FrameSight {
  // Heights that rays pass, above the scene's origin: of the antenna, the ground
  // within range and the targets in view.
  double lowest_m = 0.0;
  double highest_m = 0.0;
  // What the fan meets first may mirror: the only rays that double bounce follows.
  bool mirrors = false;
  // A mirrored ray may meet something within range: a body, or the ground.
  bool mirrored_rays_end = false;
  bool ground_mirrors = false;                   // within range, at any azimuth
  bool point_targets = false;                    // inside the range gate and the beam
  std::vector<atmosphere::RainCell> rain_cells;  // within range
  double largest_eta_m2_per_m3 = 0.0;            // of rain and snow within range and beam
  bool leaves_ground = false;                    // the fan may pass the rim of the ground in range
};

SceneFacts seen_facts(const SceneFacts& scene, const FrameSight& sight);

// Whether a plan made of `planned` holds for what `seen` names: both narrowed from the same scene.
// Heights are not looked at: they count from the aircraft, not from what its antenna sees.
bool covers(const SceneFacts& planned, const SceneFacts& seen);

}  // namespace fanbeam::renderer
