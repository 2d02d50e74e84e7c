// The product "obstacles": what cast a shadow in a frame's B-scope, with its estimated height.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "sensors/shadow/shadow_obstacles.h"

namespace fanbeam::session {

// One line per obstacle under the frame's metadata as comments and the column names: range_m
// (slant, of the leading edge), azimuth_deg, height_m, error_m (one range cell of shadow), shadow_m
// (its length), truncated (1: the shadow is cut off; then uncertain is 1, too), merged (1: another object stands in the
// shadow), uncertain (1: the shadow does not tell the height; height_m and error_m are empty).
std::string obstacle_table(const std::vector<sensors::ShadowObstacle>& obstacles,
                           const core::Metadata& metadata);

}  // namespace fanbeam::session
