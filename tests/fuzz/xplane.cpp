// X-Plane's positions, values and beacons.
#include "feeds/xplane.h"

#include "tests/fuzz/aircraft_packet.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  feeds::decode_xplane_values({data, size});
  feeds::decode_xplane_beacon({data, size});
  fuzz::fuzz_aircraft_packet(feeds::decode_xplane, {data, size});
  return 0;
}
