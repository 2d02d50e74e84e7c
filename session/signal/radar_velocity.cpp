#include "session/signal/radar_velocity.h"

#include <cmath>
#include <vector>

namespace fanbeam::session {

std::optional<RadarVelocity_mps> radar_velocity_in(const core::JsonNode& node) {
  constexpr core::NumberRange kSpeeds_mps{-1e5, 1e5};
  const auto speed_mps = node.member("radar_speed_mps").number(kSpeeds_mps);
  const core::JsonNode both = node.member("radar_velocity_mps");
  const std::vector<double> told = both.numbers(kSpeeds_mps, 2);
  if (told.size() == 2) {
    // A speed beside it is that over ground, with what the velocity's two components lack.
    constexpr double kMost = 1.01, kLeast_mps = 0.01;
    const double along_mps = std::hypot(told[0], told[1]);
    if (speed_mps && along_mps > kMost * std::abs(*speed_mps) + kLeast_mps)
      node.member("radar_speed_mps")
          .error(core::ErrorClass::range, "a speed over ground no less than radar_velocity_mps, " +
                                              core::number_text(along_mps));
    return RadarVelocity_mps{told[0], told[1]};
  }
  if (both.is_array() && both.elements() < 2)
    both.error(core::ErrorClass::parse, "two numbers: forward, right");
  if (!speed_mps) return std::nullopt;
  return RadarVelocity_mps{*speed_mps, 0.0};
}

}  // namespace fanbeam::session
