// NRCS over the sine of the grazing angle, made quick for the ray loop.
//
// Holds sigma0(psi) / sin(psi) of a Phong-like material, the factor that the radar equation needs
// per unit of solid angle. Linear interpolation between 4096 steps; below sin(psi) = 1/64, where a
// steep power would make the linear error visible, the exact form. Accuracy: 1e-4 relative.
#pragma once

#include <cmath>
#include <vector>

#include "materials/nrcs/phong_nrcs.h"

namespace fanbeam::renderer {

class NrcsTable {
 public:
  explicit NrcsTable(const materials::PhongNrcs& nrcs);

  // 0 for sin_grazing <= 0: the back of a surface does not scatter.
  double sigma0_over_sine(double sin_grazing) const noexcept {
    if (sin_grazing <= 0.0) return 0.0;
    if (flat_) return values_[0];
    if (sin_grazing < kExactBelow) return nrcs_.sigma0(sin_grazing) / sin_grazing;
    const double position = std::fmin(sin_grazing, 1.0) * kSteps;
    const int index = static_cast<int>(position);
    const double share = position - index;
    return values_[static_cast<std::size_t>(index)] * (1.0 - share) +
           values_[static_cast<std::size_t>(index) + 1] * share;
  }

 private:
  static constexpr int kSteps = 4096;
  static constexpr double kExactBelow = 1.0 / 64.0;
  materials::PhongNrcs nrcs_;
  bool flat_ = false;  // sigma0 proportional to sin(psi)
  std::vector<double> values_;
};

}  // namespace fanbeam::renderer
