#include "materials/dielectric/permittivity.h"

#include "materials/checks.h"

namespace fanbeam::materials {

void check_permittivity(const Permittivity& permittivity) {
  require_range("permittivity.real", permittivity.real, 1.0, kLargestPermittivity);
  require_range("permittivity.loss", permittivity.loss, 0.0, kLargestPermittivity);
}

}  // namespace fanbeam::materials
