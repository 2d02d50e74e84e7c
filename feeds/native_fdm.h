// FlightGear's native-fdm packet, version 24: what --native-fdm=socket,out,... sends.
//
// 408 bytes in network order (FlightGear 2020.3; src/Network/net_fdm.hxx names the fields). Read
// are position, attitude, velocity, height above ground, visibility and clock; the packet's other
// fields (engines, wheels, surfaces) mean nothing to a radar. Its padding word is not looked at.
//
// Datum: `altitude_m` counts from the simulator's own sea level, in which its terrain is drawn too:
// whoever uses it says which datum that is. Angles: FlightGear turns degrees into radians with the
// 32-bit value of pi/180 (measured: 7.75e-9 too small, 5.5 cm at latitude 64); latitude and longitude
// here are freed of that, to 5e-13 deg.
// The clock has steps of a second: no timing comes from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "feeds/aircraft_state.h"

namespace fanbeam::feeds {

inline constexpr std::size_t kNativeFdm_bytes = 408;

// Nothing, and why, for what is no such packet: length, version, nonfinite or range.
std::optional<AircraftState> decode_native_fdm(std::span<const std::uint8_t> datagram,
                                               PacketFault& fault);

}  // namespace fanbeam::feeds
