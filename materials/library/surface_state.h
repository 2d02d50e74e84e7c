// The state a scene's weather leaves on its surfaces. A state is another material, not noise: each
// row of the library names what it turns into (docs/physics/surface-state.md).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace fanbeam::materials {

enum class SurfaceState {
  dry,
  wet,       // rain has fallen: films on hard surfaces, drops on leaves, moist soil
  dry_snow,  // covered with dry, refrozen snow
  wet_snow,  // covered with melting snow
};

// As files name them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> kSurfaceStateNames = {"dry", "wet", "dry-snow",
                                                                       "wet-snow"};

inline std::string_view name_of(SurfaceState state) {
  return kSurfaceStateNames[static_cast<std::size_t>(state)];
}

// `field`: what the word was given for. Throws core::InputError, E-REF, for a word that names none.
SurfaceState surface_state_of(std::string_view word, std::string_view field);

}  // namespace fanbeam::materials
