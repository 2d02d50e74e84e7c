#include "feeds/native_fdm.h"

#include <bit>
#include <type_traits>

#include "core/constants.h"
#include "core/units.h"

namespace fanbeam::feeds {
namespace {

constexpr std::uint32_t kVersion = 24;
// Degrees to radians in the precision that FlightGear 2020.3 has there.
constexpr double kFloatRadian = static_cast<double>(0.01745329238474369F);

// Of type T at an offset, in network order.
template <class T>
T field(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t> bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) bits = bits << 8 | bytes[offset + i];
  return std::bit_cast<T>(bits);
}

double number(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<double>(field<float>(bytes, offset));
}

double exact_rad(double rad) { return core::radians(rad / kFloatRadian); }

}  // namespace

std::optional<AircraftState> decode_native_fdm(std::span<const std::uint8_t> datagram,
                                               PacketFault& fault) {
  const auto refuse = [&](PacketFault why) {
    fault = why;
    return std::nullopt;
  };
  if (datagram.size() != kNativeFdm_bytes) return refuse(PacketFault::length);
  if (field<std::uint32_t>(datagram, 0) != kVersion) return refuse(PacketFault::version);
  AircraftState packet;
  packet.longitude_rad = exact_rad(field<double>(datagram, 8));
  packet.latitude_rad = exact_rad(field<double>(datagram, 16));
  packet.altitude_m = field<double>(datagram, 24);
  packet.height_above_ground_m = number(datagram, 32);
  packet.attitude = {number(datagram, 36), number(datagram, 40), number(datagram, 44)};
  packet.v_N_mps =
      core::kFoot_m * glm::dvec3(number(datagram, 76), number(datagram, 80), number(datagram, 84));
  packet.clock_s =
      static_cast<double>(field<std::uint32_t>(datagram, 356));  // has warp in it already
  packet.visibility_m = number(datagram, 364);
  fault = fault_in(packet);
  return fault == PacketFault::none ? std::optional(packet) : std::nullopt;
}

}  // namespace fanbeam::feeds
