#include "materials/dielectric/permittivity.h"

#include "core/number_range.h"

namespace fanbeam::materials {

void check_permittivity(const Permittivity& permittivity) {
  core::require_range("permittivity.real", permittivity.real, {1.0, kLargestPermittivity});
  core::require_range("permittivity.loss", permittivity.loss, {0.0, kLargestPermittivity});
}

}  // namespace fanbeam::materials
