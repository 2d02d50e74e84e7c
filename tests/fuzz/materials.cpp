// Material and object libraries.
#include <cmath>

#include "materials/library/material_library.h"
#include "materials/rcs/object_library.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const materials::MaterialLibrary library =
        materials::MaterialLibrary::from_text(text, "library.toml", problems);
    if (problems.has_errors()) return;
    for (const auto state : {materials::SurfaceState::dry, materials::SurfaceState::wet})
      library.curves(state, core::Polarisation::horizontal, 35e9);
  });
  fuzz::expect_answer([&](core::ProblemList& problems) {
    materials::ObjectLibrary::from_text(text, "objects.toml", problems);
  });
  return 0;
}
