// run.json and timing.json of fanbeam fmcw.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "session/signal/chain.h"
#include "session/signal/radar_velocity.h"

namespace fanbeam::session {

struct FmcwTruth {  // a point target that the frame sees
  std::string name;
  core::Echo echo;
};

struct FmcwCounts {
  std::size_t detections = 0;
  int clusters = 0;
};

struct FmcwScanCounts {  // of product bscope
  int looks = 0;
  std::uint64_t rays = 0, scatterers = 0;
  double phase_noise_rad = 0.0;
  std::size_t clipped = 0;
  core::EffectPlan plan;
  double ms = 0.0;  // for timing.json
};

struct FmcwFrameRecord {
  int index = 0;
  double time_s = 0.0;
  double radar_speed_mps = 0.0;  // over ground
  RadarVelocity_mps radar_velocity_mps{};
  std::set<std::string> files;      // relative to the folder
  std::vector<std::string> events;  // of renderer::FrameEchoes
  std::optional<FmcwScanCounts> scan;
  bool chain = false;  // what follows is known
  std::uint64_t rays = 0;
  std::size_t paths = 0;
  double received_W = 0.0;  // sum over paths, at one receiver's port
  std::vector<FmcwTruth> targets;
  std::optional<FmcwCounts> found;  // where detections were looked for
  std::vector<core::Problem> warnings;
  bool keystone = false;
  double synthesis_error = 0.0, phase_noise_rad = 0.0;
  std::size_t clipped = 0, crossed = 0, mended = 0;
  core::EffectPlan plan;  // of the receiver
  // For timing.json.
  double echoes_ms = 0.0, signal_ms = 0.0, writing_ms = 0.0;
};

// Everything but the times.
FmcwFrameRecord fmcw_record(const scenes::Scene& scene, int index, const FmcwPaths& paths,
                            const FmcwFrame& frame);

// `files`: of all frames together. What is listed nowhere counts as somebody's (output_folder.h).
std::string fmcw_run_json(const scenes::Scene& scene, const FmcwSettings& options,
                          const FmcwRadar& radar, const std::vector<FmcwFrameRecord>& frames,
                          const std::set<std::string>& files);
std::string fmcw_timing_json(int threads, double scene_build_s,
                             const std::vector<FmcwFrameRecord>& frames);

}  // namespace fanbeam::session
