// Lines of FlightGear's generic protocol.
#include "feeds/fg_generic.h"

#include <cmath>

#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  feeds::PacketFault fault{};
  const auto state = feeds::decode_fg_generic({data, size}, fault);
  fuzz::must(state.has_value() == (fault == feeds::PacketFault::none), "a reason or a line");
  if (!state) return 0;
  const core::Pose pose = feeds::pose_of(*state);
  fuzz::must(std::isfinite(pose.position.latitude_rad + pose.position.longitude_rad +
                           pose.position.height_m + pose.q_NB.w + pose.v_N_mps.x),
             "finite poses");
  return 0;
}
