#include "feeds/xplane.h"

#include <algorithm>
#include <string>

#include "core/units.h"
#include "feeds/bytes.h"

namespace fanbeam::feeds {
namespace {

constexpr std::size_t kWord_bytes = 5;  // with the byte behind it

bool begins(std::span<const std::uint8_t> datagram, std::string_view word) {
  return datagram.size() >= kWord_bytes && std::equal(word.begin(), word.end(), datagram.begin());
}

std::vector<std::uint8_t> request(std::string_view word, std::size_t bytes) {
  std::vector<std::uint8_t> datagram(bytes, 0);
  std::copy(word.begin(), word.end(), datagram.begin());
  return datagram;
}

}  // namespace

std::optional<AircraftState> decode_xplane(std::span<const std::uint8_t> datagram,
                                           PacketFault& fault) {
  constexpr std::size_t kPosition_bytes = 69;
  const auto refuse = [&](PacketFault why) {
    fault = why;
    return std::nullopt;
  };
  if (!begins(datagram, "RPOS")) return refuse(PacketFault::version);
  if (datagram.size() != kPosition_bytes) return refuse(PacketFault::length);
  Fields f(datagram.subspan(kWord_bytes), kSwapLittle);
  AircraftState state;
  state.longitude_rad = core::radians(f.number64(0));
  state.latitude_rad = core::radians(f.number64(8));
  state.altitude_m = f.number64(16);
  state.height_above_ground_m = f.number32(24);
  state.attitude.pitch_rad = core::radians(f.number32(28));
  state.attitude.heading_rad = core::radians(f.number32(32));
  state.attitude.roll_rad = core::radians(f.number32(36));
  state.v_N_mps = {-f.number32(48), f.number32(40), -f.number32(44)};
  fault = fault_in(state);
  return fault == PacketFault::none ? std::optional(state) : std::nullopt;
}

std::optional<std::vector<std::pair<std::int32_t, double>>> decode_xplane_values(
    std::span<const std::uint8_t> datagram) {
  constexpr std::size_t kPair_bytes = 8;
  if (!begins(datagram, "RREF") || (datagram.size() - kWord_bytes) % kPair_bytes != 0)
    return std::nullopt;
  std::vector<std::pair<std::int32_t, double>> values;
  const Fields f(datagram.subspan(kWord_bytes), kSwapLittle);
  for (std::size_t at = 0; at < datagram.size() - kWord_bytes; at += kPair_bytes)
    values.emplace_back(f.at<std::int32_t>(at), static_cast<double>(f.at<float>(at + 4)));
  return values;
}

std::optional<XPlaneBeacon> decode_xplane_beacon(std::span<const std::uint8_t> datagram) {
  constexpr std::size_t kShortest_bytes = kWord_bytes + 16;  // the machine's name follows
  constexpr std::uint8_t kMajorVersion = 1;
  constexpr std::int32_t kXPlane = 1;
  constexpr std::uint32_t kMaster = 1;
  if (!begins(datagram, "BECN") || datagram.size() < kShortest_bytes) return std::nullopt;
  const Fields f(datagram.subspan(kWord_bytes), kSwapLittle);
  if (f.byte(0) != kMajorVersion) return std::nullopt;
  return XPlaneBeacon{f.at<std::int32_t>(2) == kXPlane && f.at<std::uint32_t>(10) == kMaster,
                      f.at<std::int32_t>(6), f.at<std::uint16_t>(14)};
}

std::vector<std::uint8_t> xplane_position_request(int rate_Hz) {
  const std::string rate = std::to_string(rate_Hz);
  std::vector<std::uint8_t> datagram = request("RPOS", kWord_bytes + rate.size() + 1);
  std::copy(rate.begin(), rate.end(), datagram.begin() + kWord_bytes);
  return datagram;
}

std::vector<std::uint8_t> xplane_value_request(int rate_Hz, std::int32_t index,
                                               std::string_view name) {
  constexpr std::size_t kName_bytes = 400, kHead_bytes = kWord_bytes + 8;
  std::vector<std::uint8_t> datagram = request("RREF", kHead_bytes + kName_bytes);
  const auto put = [&](std::size_t at, std::int32_t value) {
    const std::int32_t ordered = kSwapLittle ? swapped(value) : value;
    std::memcpy(datagram.data() + at, &ordered, sizeof ordered);
  };
  put(kWord_bytes, rate_Hz);
  put(kWord_bytes + 4, index);
  name = name.substr(0, kName_bytes - 1);
  std::copy(name.begin(), name.end(), datagram.begin() + kHead_bytes);
  return datagram;
}

}  // namespace fanbeam::feeds
