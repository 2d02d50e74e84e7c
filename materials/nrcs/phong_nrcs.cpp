#include "materials/nrcs/phong_nrcs.h"

#include "materials/checks.h"

namespace fanbeam::materials {

PhongNrcs::PhongNrcs(double a, double b, double c) : a_(a), b_(b), c_(c) {
  require_range("a", a, 0.0, kLargestPhongCoefficient);
  require_range("b", b, 0.0, kLargestPhongCoefficient);
  require_range("c", c, 0.0, kLargestPhongExponent);
}

}  // namespace fanbeam::materials
