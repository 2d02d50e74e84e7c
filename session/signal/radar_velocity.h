// How a radar itself moves, as the files of signals and detections tell it.
#pragma once

#include <array>
#include <optional>

#include "core/json_node.h"

namespace fanbeam::session {

// Over ground, in the antenna's axes, as azimuths are: forward, right.
using RadarVelocity_mps = std::array<double, 2>;

// Of a member `radar_velocity_mps`, else of `radar_speed_mps` alone, which is one along the antenna's axis: files
// of before the velocity had two components. Nothing without either. E-RANGE beyond 1e5 m/s and
// for a speed below the velocity beside it, E-PARSE for another number of components.
std::optional<RadarVelocity_mps> radar_velocity_in(const core::JsonNode& node);

}  // namespace fanbeam::session
