// A native-fdm packet put together by hand.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace fanbeam::tests {

inline void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t bits, int size) {
  for (int i = 0; i < size; ++i)
    bytes[at + static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(bits >> (8 * (size - 1 - i)));
}
inline void put(std::vector<std::uint8_t>& bytes, std::size_t at, double value) {
  put(bytes, at, std::bit_cast<std::uint64_t>(value), 8);
}
inline void put(std::vector<std::uint8_t>& bytes, std::size_t at, float value) {
  put(bytes, at, std::bit_cast<std::uint32_t>(value), 4);
}

// At 52 N 10 E, 200 m, heading east, 100 ft/s; angles in radians as given.
inline std::vector<std::uint8_t> native_fdm_bytes(double latitude_rad, double longitude_rad) {
  std::vector<std::uint8_t> bytes(408, 0xA5);  // what nobody reads is anything
  put(bytes, 0, 24, 4);
  put(bytes, 8, longitude_rad);
  put(bytes, 16, latitude_rad);
  put(bytes, 24, 200.0);
  put(bytes, 32, 150.0F);
  put(bytes, 36, 0.1F);
  put(bytes, 40, -0.05F);
  put(bytes, 44, 1.5F);
  put(bytes, 76, 0.0F);
  put(bytes, 80, 100.0F);
  put(bytes, 84, 5.0F);
  put(bytes, 356, 1'700'000'000, 4);
  put(bytes, 364, 5000.0F);
  return bytes;
}

}  // namespace fanbeam::tests
