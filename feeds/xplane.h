// X-Plane's datagrams, little-endian: position that it sends to who asks, weather, and its beacon.
//
// Source: Laminar Research, "Exchanging Data with X-Plane" (shipped with the simulator, versions 11 and
// 12). Each begins with a word of four letters and a byte that differs by version and means nothing.
//   RPOS  longitude, latitude in deg and elevation above mean sea level in m (f64), then f32: height
//         above ground in m, pitch, true heading, roll in deg, velocity to east, up and south in m/s,
//         three rates
//   RREF  pairs of an index, as it was asked with, and a value (f32)
//   BECN  where a simulator listens; multicast to kBeaconAddress
// Weather is no part of RPOS: AircraftState has none.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "feeds/aircraft_state.h"

namespace fanbeam::feeds {

inline constexpr std::string_view kBeaconAddress = "239.255.1.1";
inline constexpr std::uint16_t kBeaconPort = 49707;

// Nothing, and why: length (other than 69 bytes), version (no RPOS), or fault_in() of the state.
std::optional<AircraftState> decode_xplane(std::span<const std::uint8_t> datagram,
                                           PacketFault& fault);

// Index and value, which need not be a finite number. Nothing where it is no RREF, or not of whole pairs.
std::optional<std::vector<std::pair<std::int32_t, double>>> decode_xplane_values(
    std::span<const std::uint8_t> datagram);

struct XPlaneBeacon {
  bool is_simulator = false;  // X-Plane itself, the master of its machines
  std::int32_t version = 0;   // 120100 is 12.1
  std::uint16_t port = 0;     // that it listens at
};
std::optional<XPlaneBeacon> decode_xplane_beacon(std::span<const std::uint8_t> datagram);

// What asks for positions so many times a second, 0 for none.
std::vector<std::uint8_t> xplane_position_request(int rate_Hz);
// The same for a value of the simulator, by its name of at most 399 letters.
std::vector<std::uint8_t> xplane_value_request(int rate_Hz, std::int32_t index,
                                               std::string_view name);

}  // namespace fanbeam::feeds
