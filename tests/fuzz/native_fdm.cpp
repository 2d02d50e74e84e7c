// Datagrams of FlightGear.
#include "feeds/native_fdm.h"

#include <cmath>

#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  feeds::PacketFault fault{};
  const auto packet = feeds::decode_native_fdm({data, size}, fault);
  fuzz::must(packet.has_value() == (fault == feeds::PacketFault::none), "a reason or a packet");
  if (!packet) return 0;
  const core::Pose pose = feeds::pose_of(*packet);
  fuzz::must(std::isfinite(pose.position.latitude_rad + pose.position.longitude_rad +
                           pose.position.height_m + pose.q_NB.w + pose.v_N_mps.x),
             "finite poses");
  return 0;
}
