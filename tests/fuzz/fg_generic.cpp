// Lines of FlightGear's generic protocol.
#include "feeds/fg_generic.h"

#include "tests/fuzz/aircraft_packet.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::fuzz_aircraft_packet(feeds::decode_fg_generic, {data, size});
  return 0;
}
