// Datagrams of FlightGear.
#include "feeds/native_fdm.h"

#include "tests/fuzz/aircraft_packet.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::fuzz_aircraft_packet(feeds::decode_native_fdm, {data, size});
  return 0;
}
