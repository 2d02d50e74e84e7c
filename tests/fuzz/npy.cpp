// NumPy files that somebody recorded.
#include "core/npy.h"

#include <algorithm>
#include <cmath>

#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::scratch_file("samples.npy", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList&) {
    const core::NpyHeader header = core::read_npy_header(file);
    fuzz::must(!header.shape.empty() && header.count() > 0, "values");
    const std::size_t count = std::min<std::size_t>(header.count(), 10'000);
    const auto values = core::read_npy(file, header, header.count() - count, count);
    for (const auto& value : values)
      fuzz::must(std::isfinite(value.real()) && std::isfinite(value.imag()), "finite values");
  });
  return 0;
}
