// Recordings of live channels.
#include <cmath>

#include "live/recording.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("flight.jsonl", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList&) {
    const live::Recording recording = live::read_recording(file);
    for (const auto& event : recording.events)
      if (const auto* frame = std::get_if<live::RecordedFrame>(&event))
        fuzz::must(std::isfinite(frame->tick.at_s + frame->tick.now_s + frame->samples) &&
                       frame->tick.number > 0,
                   "finite times");
  });
  return 0;
}
