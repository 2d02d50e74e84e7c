// A CIGI host's messages, put together by hand, and an image generator over a small scene that hears them.
#pragma once

#include <catch2/catch.hpp>
#include <numeric>
#include <utility>

#include "feeds/bytes.h"
#include "live/cigi_ig.h"
#include "tests/live/live_scene.h"

namespace fanbeam::tests {

using feeds::Fields;
using feeds::Packet;
using feeds::cigi::Bytes;
using live::CigiIg;
using live::Clock;

enum : std::uint8_t { kStandby = 0x30, kOperate = 0x31 };

// The byte order that is not this machine's, on request.
inline Bytes message(std::uint32_t frame, const std::vector<Bytes>& packets,
                     std::uint8_t mode = kOperate, bool swap = false, std::int8_t database = 1) {
  Bytes bytes = Packet(1, 24, swap)
                    .put<std::uint8_t>(2, 3)
                    .put(3, database)
                    .put(4, mode)
                    .put<std::uint16_t>(6, 0x8000)
                    .put(8, frame)
                    .bytes();
  for (const Bytes& packet : packets) bytes.insert(bytes.end(), packet.begin(), packet.end());
  return bytes;
}

inline Bytes entity(double latitude_deg, double longitude_deg, double height_m,
                    float heading_deg = 90.0F, bool swap = false, std::uint16_t number = 0) {
  return Packet(2, 48, swap)
      .put(2, number)
      .put<std::uint8_t>(4, 1)
      .put(12, 3.0F)
      .put(16, -2.0F)
      .put(20, heading_deg)
      .put(24, latitude_deg)
      .put(32, longitude_deg)
      .put(40, height_m)
      .bytes();
}

inline Bytes height_request(std::uint16_t number, double latitude_deg, double longitude_deg,
                            double height_m, std::uint8_t kind = 2, std::uint8_t period = 0) {
  return Packet(24, 32, false)
      .put(2, number)
      .put(4, kind)
      .put(5, period)
      .put(8, latitude_deg)
      .put(16, longitude_deg)
      .put(24, height_m)
      .bytes();
}

inline Bytes weather(std::uint8_t layer, float visibility_m, float water,
                     std::uint8_t severity = 0) {
  return Packet(12, 56, false)
      .put<std::uint8_t>(4, layer)
      .put<std::uint8_t>(6, 1)
      .put(7, static_cast<std::uint8_t>(severity << 2U))
      .put(12, visibility_m)
      .put(52, water)
      .bytes();
}

// A packet of an answer, which it owns.
struct Told {
  explicit Told(Bytes packet) : first(packet[0]), bytes(std::move(packet)), second(bytes, false) {}
  Told(Told&&) = default;  // the bytes stay where they are
  int first;
  Bytes bytes;
  Fields second;
};

// Start of frame first.
inline std::vector<Told> packets_in(const Bytes& message) {
  std::vector<Told> packets;
  for (std::size_t at = 0; at < message.size(); at += message[at + 1]) {
    REQUIRE(message[at + 1] % 8 == 0);
    REQUIRE(at + message[at + 1] <= message.size());
    const auto begin = message.begin() + static_cast<std::ptrdiff_t>(at);
    packets.emplace_back(Bytes(begin, begin + message[at + 1]));
  }
  REQUIRE(!packets.empty());
  REQUIRE(packets[0].first == 101);
  return packets;
}

inline std::uint64_t all_of(const std::vector<std::pair<std::string, std::uint64_t>>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& one) { return sum + one.second; });
}

struct Station {
  tests::TemporaryFolder folder;
  std::unique_ptr<session::Session> session = tests::live_session(folder);
  CigiIg ig{*session, core::VerticalDatum::scene};
  Clock::time_point now = Clock::now();

  void hear(const Bytes& bytes, const std::string& host = "127.0.0.1:8001") {
    now += std::chrono::milliseconds(60);
    ig.take(bytes, host, now);
  }
  std::size_t poses() const { return ig.mailbox().after(0).size(); }
  core::Pose pose() const { return ig.mailbox().after(0).back().pose; }
  live::Status told() const {
    live::Status status;
    ig.tell(status);
    return status;
  }
};

}  // namespace fanbeam::tests
