// Packet captures and raw recordings put together by hand.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace fanbeam::tests {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& bytes, std::uint64_t value, int size, bool little) {
  for (int i = 0; i < size; ++i)
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * (little ? i : size - 1 - i))));
}

// RFC 768 in RFC 791, without checksums.
inline Bytes ipv4_udp(std::uint16_t port, const Bytes& payload, std::uint32_t fragment = 0) {
  Bytes bytes{0x46, 0};  // four bytes of options
  append(bytes, 24 + 8 + payload.size(), 2, false);
  append(bytes, 0, 2, false);
  append(bytes, fragment, 2, false);
  bytes.insert(bytes.end(), {64, 17, 0, 0, 127, 0, 0, 1, 127, 0, 0, 1, 1, 1, 1, 1});
  append(bytes, 40000, 2, false);
  append(bytes, port, 2, false);
  append(bytes, 8 + payload.size(), 2, false);
  append(bytes, 0, 2, false);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

inline Bytes behind(Bytes header, const Bytes& rest) {
  header.insert(header.end(), rest.begin(), rest.end());
  return header;
}

inline Bytes capture_header(std::uint32_t link, bool little = true,
                            std::uint32_t magic = 0xa1b2c3d4) {
  Bytes bytes;
  append(bytes, magic, 4, little);
  append(bytes, 2, 2, little);
  append(bytes, 4, 2, little);
  append(bytes, 0, 8, little);
  append(bytes, 65535, 4, little);
  append(bytes, link, 4, little);
  return bytes;
}

inline void append_record(Bytes& capture, std::uint32_t seconds, std::uint32_t fraction,
                          const Bytes& frame, bool little = true, std::size_t cut = 0) {
  append(capture, seconds, 4, little);
  append(capture, fraction, 4, little);
  append(capture, frame.size(), 4, little);
  append(capture, frame.size() + cut, 4, little);
  capture.insert(capture.end(), frame.begin(), frame.end());
}

inline void append_raw(Bytes& recording, double time_s, std::uint16_t port, const Bytes& payload) {
  append(recording, std::bit_cast<std::uint64_t>(time_s), 8, true);
  append(recording, port, 2, true);
  append(recording, payload.size(), 2, true);
  recording.insert(recording.end(), payload.begin(), payload.end());
}

}  // namespace fanbeam::tests
