// Measured antenna patterns: CSV cuts and MSI Planet files.
#include <cmath>

#include "sensors/antenna/pattern_file.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* name : {"cut.csv", "cut.msi"}) {
    const std::filesystem::path file = fuzz::scratch_file(name, fuzz::text_of(data, size));
    for (const auto plane : {sensors::PatternPlane::azimuth, sensors::PatternPlane::elevation}) {
      fuzz::expect_answer([&](core::ProblemList& problems) {
        const sensors::PatternCut cut = sensors::read_pattern_cut(file, plane, problems);
        if (problems.has_errors()) return;
        for (const double gain : cut.gain)
          fuzz::must(std::isfinite(gain) && gain >= 0.0, "finite gains of 0 or more");
      });
    }
  }
  return 0;
}
