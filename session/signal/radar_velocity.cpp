#include "session/signal/radar_velocity.h"

#include <vector>

namespace fanbeam::session {

std::optional<RadarVelocity_mps> radar_velocity_in(const core::JsonNode& node) {
  constexpr core::NumberRange kSpeeds_mps{-1e5, 1e5};
  const auto speed_mps = node.member("radar_speed_mps").number(kSpeeds_mps);
  const core::JsonNode both = node.member("radar_velocity_mps");
  const std::vector<double> told = both.numbers(kSpeeds_mps, 2);
  if (told.size() == 2) return RadarVelocity_mps{told[0], told[1]};
  if (both.is_array() && both.elements() < 2)
    both.error(core::ErrorClass::parse, "two numbers: forward, right");
  if (!speed_mps) return std::nullopt;
  return RadarVelocity_mps{*speed_mps, 0.0};
}

}  // namespace fanbeam::session
