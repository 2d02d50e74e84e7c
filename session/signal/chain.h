// The receiving chain of one frame: beat cube, transforms, maps, detections.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/errors.h"
#include "session/signal/paths.h"
#include "session/signal/radar.h"
#include "session/signal/receiver_plan.h"
#include "signal/cube.h"
#include "signal/synthesis/interference.h"
#include "signal/transform/cube_maps.h"
#include "signal/transform/top_view.h"

namespace fanbeam::session {

struct FmcwDetections {
  std::vector<signal::RadarDetection> detections;
  std::vector<int> clusters;  // of each, or signal::kNoCluster
};

struct FmcwFrame {
  std::vector<signal::FloatCube> beats;  // of every stage
  // What the products need of these; the rest stays empty.
  std::optional<FmcwDetections> found;
  signal::FloatCube cube;          // azimuth, speed, range
  signal::PowerMap range_doppler;  // sum over channels
  signal::PowerMap range_azimuth;  // largest over speeds
  signal::TopViewGrid grid;
  signal::PowerMap top_view;
  std::vector<core::Problem> warnings;  // of folding
  bool keystone = false;                // how stage 0 was synthesised
  double synthesis_error = 0.0;         // relative, estimated or asked for
  core::EffectPlan plan;                // of the receiver
  double phase_noise_rad = 0.0;         // 0 where it does not run
  std::size_t clipped = 0;              // parts of samples, by the quantiser
  std::size_t crossed = 0;              // samples of the first channel that other radars cross
  std::size_t mended = 0;               // samples of all channels, by the mitigation
};

// Does what the names of `products` need (kFmcwProducts; maps mark the detections). The draws are
// keyed by the options' seed, `frame` and the stage. What the receiver does to the samples is
// planned from them and `budget`.
FmcwFrame fmcw_frame(const FmcwRadar& radar, const std::vector<signal::ScatterPath>& paths,
                     int frame, const FmcwSettings& options, const std::set<std::string>& products,
                     const SignalBudget& budget = {},
                     const std::vector<signal::Interferer>& interferers = {});
// The same of a frame of a scene, whose `paths` fmcw_paths gave.
FmcwFrame fmcw_frame(const FmcwRadar& radar, const scenes::Scene& scene, const FmcwPaths& paths,
                     int frame, const FmcwSettings& options, const std::set<std::string>& products);

// E-RANGE where what `products` need has detections and the radar cannot detect (check_detects): to
// be asked before any rays are cast. Nothing for waveforms without maps.
void check_processing(const FmcwRadar& radar, const std::set<std::string>& products);

// Maps and detections of frame.beats[0], as the names of `products` need them: the way down from
// samples, whoever made them.
void process_samples(const FmcwRadar& radar, const ProcessingSettings& settings,
                     const std::set<std::string>& products, FmcwFrame& frame);

}  // namespace fanbeam::session
