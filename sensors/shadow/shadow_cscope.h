// The C-scope of a fan-beam radar with obstacles raised to the heights their shadows tell.
//
// The picture is flat_earth_cscope_W_m3, and in each column of an obstacle the rows from its foot
// at elevation -asin(h / R) to its top at asin((height - h) / R) show its leading edge: P R^3 of
// the brightest cell within three rows of R, times the range cells R^2 / (h cell) that a row of
// flat ground holds there per radian: the bar stands out of the ground as the edge does in the
// B-scope. Obstacles without a certain height are not raised: their edge stays bright ground.
// Since the ray over the top ends where the shadow ends, the bar covers just the shadow behind it.
// Elevations count from the local horizontal, as in flat_earth. Bars are drawn as wide as the
// shadow, not as the beam smears the bright edge. Farther obstacles are drawn first.
//
// Heights are estimates, see shadow_obstacles.h for what they neglect.
#pragma once

#include <span>
#include <vector>

#include "sensors/sensor.h"
#include "sensors/shadow/shadow_obstacles.h"

namespace fanbeam::sensors {

// W m^3, as cscope_grey takes it, from B-scope power in W with its noise. Throws as
// flat_earth_cscope_W_m3.
std::vector<double> shadow_cscope_W_m3(const Sensor& sensor, std::span<const double> power_W,
                                       double height_m,
                                       const std::vector<ShadowObstacle>& obstacles);

}  // namespace fanbeam::sensors
