// Where an aircraft may be when a frame is asked for: what a scene's plan counts on beside its
// ground, weather and sensor.
//
// A trajectory fills it; a scene without one states it ([flight_volume]), or has the air over its
// terrain from the lowest ground to one range window above the highest: from farther up the sensor
// meets no ground. A plan for a stated volume holds for every attitude.
#pragma once

#include "scenes/description.h"
#include "scenes/site.h"
#include "scenes/trajectory/trajectory.h"
#include "sensors/sensor.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

// In the scene's frame: heights are of its horizontal plane.
struct FlightVolume {
  double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;
  double lowest_m = 0.0, highest_m = 0.0;
  // Smallest and largest angle between the vertical of a place in it and that of the scene's origin.
  double least_vertical_turn_rad = 0.0, vertical_turn_rad = 0.0;

  // A pose between two at the same place is there but for rounding.
  static constexpr double kRounding_m = 1e-3;

  bool holds_height(double up_m) const {
    return up_m >= lowest_m - kRounding_m && up_m <= highest_m + kRounding_m;
  }
  bool holds(const glm::dvec3& at_m) const {
    return at_m.x >= west_m - kRounding_m && at_m.x <= east_m + kRounding_m &&
           at_m.y >= south_m - kRounding_m && at_m.y <= north_m + kRounding_m &&
           holds_height(at_m.z);
  }
};

// Of a scene: what it states, else what its trajectory flies through.
FlightVolume flight_volume(const SceneDescription& scene, const terrain::LocalFrame& frame,
                           const std::optional<Trajectory>& trajectory,
                           const terrain::HeightField& ground, const SiteFacts& site);

}  // namespace fanbeam::scenes
