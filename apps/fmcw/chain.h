// The receiving chain of one frame: beat cube, transforms, maps, detections.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/fmcw/paths.h"
#include "apps/fmcw/radar.h"
#include "core/errors.h"
#include "signal/cube.h"
#include "signal/transform/cube_maps.h"
#include "signal/transform/top_view.h"

namespace fanbeam::apps {

struct FmcwFrame {
  std::vector<signal::FloatCube> beats;  // of every stage
  // Where the waveform has maps.
  signal::FloatCube cube;            // azimuth, speed, range
  std::vector<double> azimuths_rad;  // of the cube's cells, rising
  signal::PowerMap range_doppler;    // sum over channels
  signal::PowerMap range_azimuth;    // largest over speeds
  signal::TopViewGrid grid;
  signal::PowerMap top_view;
  std::vector<signal::RadarDetection> detections;
  std::vector<int> clusters;            // of each detection, or signal::kNoCluster
  std::vector<core::Problem> warnings;  // of folding
  bool keystone = false;                // how stage 0 was synthesised
  double synthesis_error = 0.0;         // relative, estimated or asked for
  double phase_noise_rad = 0.0;
  std::size_t clipped = 0;  // parts of samples, by the quantiser
};

// The default radar's twelve elements make beams 8.5 deg wide: five cells each.
inline constexpr int kAngleCells = 64;

// `with_maps`: everything beyond the samples. The draws are keyed by the options' seed and `frame`.
FmcwFrame fmcw_frame(const FmcwRadar& radar, const sensors::Sensor& sensor,
                     const std::vector<signal::ScatterPath>& paths, int frame,
                     const FmcwOptions& options, bool with_maps);

}  // namespace fanbeam::apps
