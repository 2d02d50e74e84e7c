// Packet captures and raw recordings of datagrams.
#include "feeds/packet_file.h"

#include <cmath>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::scratch_file("packets", fuzz::text_of(data, size));
  std::int64_t before = -1;
  std::size_t told = 0;
  fuzz::expect_answer([&](core::ProblemList& problems) {
    feeds::read_datagrams(
        file,
        [&](const feeds::RecordedDatagram& datagram) {
          fuzz::must(std::isfinite(datagram.time_s), "times are finite");
          fuzz::must(datagram.byte_offset > before, "records go on");
          before = datagram.byte_offset;
          told += datagram.bytes.size();
          const std::vector<std::uint8_t> copy(datagram.bytes.begin(), datagram.bytes.end());
          fuzz::must(copy.size() == datagram.bytes.size(), "bytes that can be read");
        },
        problems);
  });
  fuzz::must(told <= size, "no byte that the file has not");
  return 0;
}
