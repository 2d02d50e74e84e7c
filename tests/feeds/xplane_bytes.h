// X-Plane's datagrams by the vendor's description, put together by hand.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/feeds/packet_bytes.h"

namespace fanbeam::tests {

inline Bytes xplane_word(std::string_view word, char fifth = '\0') {
  Bytes bytes(word.begin(), word.end());
  bytes.push_back(static_cast<std::uint8_t>(fifth));
  return bytes;
}

inline Bytes xplane_position(double latitude_deg, double longitude_deg, double elevation_m,
                             char fifth = '\0') {
  Bytes bytes = xplane_word("RPOS", fifth);
  for (const double value : {longitude_deg, latitude_deg, elevation_m})
    append(bytes, std::bit_cast<std::uint64_t>(value), 8, true);
  // Height above ground, pitch, heading, roll, velocity to east, up, south, three rates.
  for (const float value : {210.0F, -3.0F, 84.5F, 1.5F, 60.0F, -4.0F, 7.0F, 0.0F, 0.0F, 0.0F})
    append(bytes, std::bit_cast<std::uint32_t>(value), 4, true);
  return bytes;
}

inline Bytes xplane_values(const std::vector<std::pair<std::int32_t, float>>& values) {
  Bytes bytes = xplane_word("RREF", ',');
  for (const auto& [index, value] : values) {
    append(bytes, static_cast<std::uint32_t>(index), 4, true);
    append(bytes, std::bit_cast<std::uint32_t>(value), 4, true);
  }
  return bytes;
}

// Of X-Plane 12.1; role 1 is the master, 2 another machine's view.
inline Bytes xplane_beacon(std::uint16_t port, std::uint32_t role = 1) {
  Bytes bytes = xplane_word("BECN");
  bytes.insert(bytes.end(), {1, 2});
  append(bytes, 1, 4, true);
  append(bytes, 120100, 4, true);
  append(bytes, role, 4, true);
  append(bytes, port, 2, true);
  for (const char letter : std::string_view("cockpit"))
    bytes.push_back(static_cast<std::uint8_t>(letter));
  bytes.push_back(0);
  return bytes;
}

}  // namespace fanbeam::tests
