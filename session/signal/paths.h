// From a frame of a scene to what the signal sees of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/echo.h"
#include "scenes/scene.h"
#include "session/signal/fmcw_settings.h"
#include "session/signal/radar_velocity.h"
#include "signal/scatter_path.h"
#include "signal/synthesis/interference.h"

namespace fanbeam::session {

struct FmcwPaths {
  std::uint64_t rays = 0;
  std::vector<core::Echo> targets;  // the echoes of point targets among the paths
  std::vector<signal::ScatterPath> paths;
  std::vector<signal::Interferer> interferers;  // that the frame hears (interferers.h)
  std::vector<std::string> events;              // of renderer::FrameEchoes
};

// One-way power of an array's element towards an azimuth, relative to its peak: the sensor's
// azimuth pattern. A sensor whose beam scans a field of view wider than the beam is taken as an
// array that lights the field evenly and forms the beams afterwards: 1 inside the field, 0 outside.
double element_gain(const sensors::Sensor& sensor, double azimuth_rad);

// Of the antenna over ground in a frame, along its own axes: forward, right. Without what its lever arm adds in a
// turn, as in the echoes' radial speeds.
RadarVelocity_mps own_velocity_mps(const scenes::Scene& scene, int frame);

// Echoes of a frame, weighted with the element's two-way pattern; those of weight 0 are left out, and
// surfaces and targets more than 90 deg aside: a linear array cannot tell front from back.
// The clock's zero of the waveform is the frame's time.
FmcwPaths fmcw_paths(const scenes::Scene& scene, int frame, const FmcwSettings& options);

}  // namespace fanbeam::session
