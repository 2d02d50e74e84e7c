// run.json and timing.json of fanbeam fmcw.
#pragma once

#include <string>
#include <vector>

#include "apps/fmcw/chain.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

struct FmcwTruth {  // a point target that the frame sees
  std::string name;
  core::Echo echo;
};

struct FmcwFrameRecord {
  int index = 0;
  double time_s = 0.0;
  std::uint64_t rays = 0;
  std::size_t paths = 0;
  double received_W = 0.0;  // sum over paths, at one receiver's port
  std::vector<FmcwTruth> targets;
  std::size_t detections = 0;
  int clusters = 0;
  std::vector<core::Problem> warnings;
  bool keystone = false;
  double synthesis_error = 0.0, phase_noise_rad = 0.0;
  std::size_t clipped = 0;
  // For timing.json.
  double echoes_ms = 0.0, signal_ms = 0.0, writing_ms = 0.0;
};

// Everything but `paths`, the echoes' powers and times.
FmcwFrameRecord fmcw_record(const scenes::Scene& scene, int index, const FmcwPaths& paths,
                            const FmcwFrame& frame);

std::string fmcw_run_json(const scenes::Scene& scene, const FmcwOptions& options,
                          const FmcwRadar& radar, const std::vector<double>& azimuths_rad,
                          const std::vector<FmcwFrameRecord>& frames);
std::string fmcw_timing_json(int threads, double scene_build_s,
                             const std::vector<FmcwFrameRecord>& frames);

}  // namespace fanbeam::apps
