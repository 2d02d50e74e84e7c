#include "feeds/native_fdm.h"

#include "core/constants.h"
#include "core/units.h"
#include "feeds/bytes.h"

namespace fanbeam::feeds {
namespace {

constexpr std::uint32_t kVersion = 24;
// Degrees to radians in the precision that FlightGear 2020.3 has there.
constexpr double kFloatRadian = static_cast<double>(0.01745329238474369F);

double exact_rad(double rad) { return core::radians(rad / kFloatRadian); }

}  // namespace

std::optional<AircraftState> decode_native_fdm(std::span<const std::uint8_t> datagram,
                                               PacketFault& fault) {
  const auto refuse = [&](PacketFault why) {
    fault = why;
    return std::nullopt;
  };
  if (datagram.size() != kNativeFdm_bytes) return refuse(PacketFault::length);
  Fields f(datagram, kSwapBig);
  if (f.at<std::uint32_t>(0) != kVersion) return refuse(PacketFault::version);
  AircraftState packet;
  packet.longitude_rad = exact_rad(f.number64(8));
  packet.latitude_rad = exact_rad(f.number64(16));
  packet.altitude_m = f.number64(24);
  packet.height_above_ground_m = f.number32(32);
  packet.attitude = {f.number32(36), f.number32(40), f.number32(44)};
  packet.v_N_mps = core::kFoot_m * glm::dvec3(f.number32(76), f.number32(80), f.number32(84));
  packet.clock_s = f.at<std::uint32_t>(356);  // has warp in it already
  packet.visibility_m = f.number32(364);
  fault = fault_in(packet);
  return fault == PacketFault::none ? std::optional(packet) : std::nullopt;
}

}  // namespace fanbeam::feeds
