// X-Plane's positions, values and beacons.
#include "feeds/xplane.h"

#include <cmath>

#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  feeds::PacketFault fault{};
  const auto state = feeds::decode_xplane({data, size}, fault);
  fuzz::must(state.has_value() == (fault == feeds::PacketFault::none), "a reason or a position");
  if (const auto values = feeds::decode_xplane_values({data, size}))
    for (const auto& [index, value] : *values) fuzz::must(std::isfinite(value), "finite values");
  feeds::decode_xplane_beacon({data, size});
  if (!state) return 0;
  const core::Pose pose = feeds::pose_of(*state);
  fuzz::must(std::isfinite(pose.position.latitude_rad + pose.position.longitude_rad +
                           pose.position.height_m + pose.q_NB.w + pose.v_N_mps.x),
             "finite poses");
  return 0;
}
