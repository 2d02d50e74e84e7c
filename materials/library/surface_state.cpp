#include "materials/library/surface_state.h"

#include <algorithm>
#include <string>

#include "core/errors.h"

namespace fanbeam::materials {

SurfaceState surface_state_of(std::string_view word, std::string_view field) {
  const auto found = std::ranges::find(kSurfaceStateNames, word);
  if (found == kSurfaceStateNames.end())
    core::throw_input_error(core::ErrorClass::ref, std::string(field),
                            "\"" + std::string(word) + "\"", "dry, wet, dry-snow or wet-snow");
  return static_cast<SurfaceState>(found - kSurfaceStateNames.begin());
}

}  // namespace fanbeam::materials
