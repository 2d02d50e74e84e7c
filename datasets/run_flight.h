// The poses of a run: the scene's flight with the deviations drawn for it.
//
// Positions move aside, right of the track over ground, and up; attitudes are turned by roll, pitch and
// heading in body axes; times and velocities follow the speed. Turbulence is a sum of kWaves sines with
// periods of 3 to 20 s and random phases, of the RMS asked for over long times (of one run a little more
// or less): a smooth wandering, no model of an aircraft (that is scenes/trajectory). `speed_factor`
// changes when the aircraft is where, and how fast: seconds of the wandering are those of the run.
#pragma once

#include <vector>

#include "core/pose.h"
#include "datasets/draw.h"
#include "scenes/scene.h"

namespace fanbeam::datasets {

inline constexpr int kWaves = 4;

// Frames of the flight, evenly from the share `from` to the share `to` of it, each once: fewer where it has fewer.
std::vector<int> frames_of(const FrameSpread& spread, int frame_count);

// `begin_s` is when the flight begins, on the clock of `flown`: there every speed is at the same place.
core::Pose run_pose(const Draw& draw, std::uint64_t seed, const core::Pose& flown, double begin_s);

}  // namespace fanbeam::datasets
