// Where a runway lies in the pictures of a frame.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/sensor.h"

namespace fanbeam::session {

struct SeenPoint {
  double range_m = 0.0, azimuth_rad = 0.0, elevation_rad = 0.0;
  // Elevation from the local horizontal, as C-scopes of the modes flat_earth and shadow count it.
  double above_level_rad = 0.0;
};

struct RunwayView {
  std::string name;     // of the end whose landing direction is more the antenna's than the other's
  SeenPoint threshold;  // of that end
  bool threshold_ahead = true;  // else the threshold's angles mean nothing
  // Points of the centre line, from that end on, that lie in the scan's sector and between its
  // ranges.
  std::vector<SeenPoint> seen;
};

// One per runway, in the scene's order. The centre line is a straight line between the thresholds.
// `up`: the local vertical, of length 1.
std::vector<RunwayView> runway_views(const std::vector<scenes::RunwayPlace>& runways,
                                     const sensors::Sensor& sensor,
                                     const sensors::AntennaFrame& antenna, const glm::dvec3& up);

}  // namespace fanbeam::session
