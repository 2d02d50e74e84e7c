#include "feeds/cigi/ig_packets.h"

#include <algorithm>

#include "core/units.h"
#include "feeds/bytes.h"

namespace fanbeam::feeds::cigi {
namespace {

float degrees_of(double angle_rad) { return static_cast<float>(core::degrees(angle_rad)); }

std::uint8_t bit(bool set, unsigned place) {
  return static_cast<std::uint8_t>(set ? 1U << place : 0U);
}

std::uint8_t frame_bits(std::uint32_t host_frame) {
  return static_cast<std::uint8_t>((host_frame & 15U) << 4U);
}

}  // namespace

Bytes start_of_frame(const StartOfFrame& told, bool swap) {
  constexpr std::uint8_t kVersion = 3, kTimestampValid = 4;
  const auto modes = static_cast<std::uint8_t>(static_cast<unsigned>(told.mode) | kTimestampValid |
                                               static_cast<unsigned>(told.minor_version) << 4U);
  return Packet(101, 24, swap)
      .put<std::uint8_t>(2, kVersion)
      .put(3, told.database)
      .put(4, told.status)
      .put(5, modes)
      .put<std::uint16_t>(6, 0x8000)
      .put(8, told.ig_frame)
      .put(12, told.timestamp_10us)
      .put(16, told.last_host_frame)
      .bytes();
}

Bytes height_response(const HeightResponse& told, std::uint32_t host_frame, bool swap) {
  if (told.kind != HeightKind::extended)
    return Packet(102, 16, swap)
        .put(2, told.request)
        .put(4, static_cast<std::uint8_t>(bit(told.valid, 0) | bit(told.kind == HeightKind::of, 1) |
                                          frame_bits(host_frame)))
        .put(8, told.height_m)
        .bytes();
  return Packet(103, 40, swap)
      .put(2, told.request)
      .put(4, static_cast<std::uint8_t>(bit(told.valid, 0) | frame_bits(host_frame)))
      .put(8, told.height_m)
      .put(16, told.ground_m)
      .put(24, told.material)
      .put(28, degrees_of(told.normal_azimuth_rad))
      .put(32, degrees_of(told.normal_elevation_rad))
      .bytes();
}

Bytes sight_response(const SightResponse& told, std::uint32_t host_frame, bool swap) {
  constexpr std::uint8_t kOne = 1;  // response
  if (!told.extended)
    return Packet(104, 16, swap)
        .put(2, told.request)
        .put(4, static_cast<std::uint8_t>(bit(told.valid, 0) | bit(told.visible, 2) |
                                          frame_bits(host_frame)))
        .put(5, kOne)
        .put(8, told.range_m)
        .bytes();
  return Packet(105, 56, swap)
      .put(2, told.request)
      .put(4, static_cast<std::uint8_t>(bit(told.valid, 0) | bit(told.valid, 2) |
                                        bit(told.visible, 3) | frame_bits(host_frame)))
      .put(5, kOne)
      .put(8, told.range_m)
      .put(16, core::degrees(told.point.x))
      .put(24, core::degrees(told.point.y))
      .put(32, told.point.z)
      .put(44, told.material)
      .put(48, degrees_of(told.normal_azimuth_rad))
      .put(52, degrees_of(told.normal_elevation_rad))
      .bytes();
}

Bytes sensor_response(const SensorResponse& told, std::uint32_t host_frame, bool swap) {
  return Packet(told.extended ? 107 : 106, told.extended ? 48 : 24, swap)
      .put(2, told.view)
      .put(4, told.sensor)
      .put(20, host_frame)
      .bytes();
}

Bytes event_notification(const Event& told, bool swap) {
  return Packet(116, 16, swap)
      .put(2, told.event)
      .put(4, told.data[0])
      .put(8, told.data[1])
      .put(12, told.data[2])
      .bytes();
}

Bytes ig_message(std::uint16_t number, std::string_view text, bool swap) {
  constexpr std::size_t kMost = 100;
  text = text.substr(0, kMost);
  // With a zero behind it, filled up to a multiple of eight.
  const std::size_t size = (4 + text.size() + 1 + 7) / 8 * 8;
  Bytes bytes = Packet(117, static_cast<std::uint8_t>(size), swap).put(2, number).bytes();
  std::copy(text.begin(), text.end(), bytes.begin() + 4);
  return bytes;
}

}  // namespace fanbeam::feeds::cigi
