// Messages of CIGI hosts.
#include <cmath>

#include "feeds/cigi/host_packets.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;
using namespace fanbeam::feeds::cigi;

namespace {

bool finite(const glm::dvec3& value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

struct CheckFinite {
  void operator()(const EntityControl& packet) const { fuzz::must(finite(packet.place), "finite"); }
  void operator()(const HeightRequest& packet) const { fuzz::must(finite(packet.place), "finite"); }
  void operator()(const SightRequest& packet) const {
    fuzz::must(finite(packet.source) && finite(packet.end), "finite");
  }
  void operator()(const WeatherControl& packet) const {
    fuzz::must(std::isfinite(packet.aerosol_g_per_m3 + packet.base_m), "finite");
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MessageFault fault{};
  const auto message = decode_host_message({data, size}, fault);
  fuzz::must(message.has_value() == (fault == MessageFault::none), "a reason or a message");
  if (!message) return 0;
  for (const HostPacket& packet : message->packets) std::visit(CheckFinite{}, packet);
  for (const std::uint8_t id : message->passed_over) fuzz::must(!packet_name(id).empty(), "a name");
  return 0;
}
