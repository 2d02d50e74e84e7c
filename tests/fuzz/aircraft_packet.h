// What holds of every decoder of a simulator's packets (feeds/protocol.h), whatever the bytes.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "feeds/aircraft_state.h"
#include "tests/fuzz/fuzz_target.h"

namespace fanbeam::fuzz {

template <class Decode>
void fuzz_aircraft_packet(const Decode& decode, std::span<const std::uint8_t> bytes) {
  feeds::PacketFault fault{};
  const auto state = decode(bytes, fault);
  must(state.has_value() == (fault == feeds::PacketFault::none), "a reason or a packet");
  if (!state) return;
  const core::Pose pose = feeds::pose_of(*state);
  must(std::isfinite(pose.position.latitude_rad + pose.position.longitude_rad +
                     pose.position.height_m + pose.q_NB.w + pose.v_N_mps.x),
       "finite poses");
}

}  // namespace fanbeam::fuzz
