#include "materials/nrcs/phong_nrcs.h"

#include "core/number_range.h"

namespace fanbeam::materials {

PhongNrcs::PhongNrcs(double a, double b, double c) : a_(a), b_(b), c_(c) {
  core::require_range("a", a, {0.0, kLargestPhongCoefficient});
  core::require_range("b", b, {0.0, kLargestPhongCoefficient});
  core::require_range("c", c, {0.0, kLargestPhongExponent});
}

}  // namespace fanbeam::materials
