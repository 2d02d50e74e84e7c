// From a frame of a scene to what the signal sees of it.
#pragma once

#include <vector>

#include "apps/fmcw_command.h"
#include "renderer/stages/frame_echoes.h"
#include "scenes/scene.h"
#include "signal/scatter_path.h"

namespace fanbeam::apps {

struct FmcwPaths {
  renderer::FrameEchoes echoes;
  std::vector<signal::ScatterPath> paths;  // in the order of the echoes
};

// One-way power of an array's element towards an azimuth, relative to its peak: the sensor's
// azimuth pattern. A sensor whose beam scans a field of view wider than the beam is taken as an
// array that lights the field evenly and forms the beams afterwards: 1 inside the field, 0 outside.
double element_gain(const sensors::Sensor& sensor, double azimuth_rad);

// Echoes of a frame, weighted with the element's two-way pattern; those of weight 0 are left out of
// both lists. The clock's zero of the waveform is the frame's time.
FmcwPaths fmcw_paths(const scenes::Scene& scene, int frame, const FmcwOptions& options);

}  // namespace fanbeam::apps
