// NRCS over the sine of the grazing angle, made quick for the ray loop.
//
// Holds sigma0(psi) / sin(psi) of any reflectivity model, the factor that the radar equation needs
// per unit of solid angle. Linear interpolation between 4096 even steps of sin(psi), and between
// 2048 finer ones below 1/32, where steep powers bend most. Below 0.001 deg (the first fine step) a
// form that rises towards grazing without end is held. Accuracy: 1e-4 relative
// from 0.1 deg up for every row of the shipped library and every power law up to sin^4; metal with
// slopes under 0.05 has lobes steeper than the steps. Cost: one comparison and two reads.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/nrcs/nrcs_curve.h"

namespace fanbeam::renderer {

class NrcsTable {
 public:
  explicit NrcsTable(const materials::NrcsCurve& nrcs);

  // 0 for sin_grazing <= 0: the back of a surface does not scatter.
  double sigma0_over_sine(double sin_grazing) const noexcept {
    if (sin_grazing <= 0.0) return 0.0;
    const bool fine = sin_grazing < kFineBelow;
    const double position = std::fmin(sin_grazing, 1.0) * (fine ? kFineSteps / kFineBelow : kSteps);
    const int index = static_cast<int>(position);
    const double share = position - index;
    const double* value = values_.data() + (index + (fine ? kCoarseEntries : 0));
    return value[0] + (value[1] - value[0]) * share;
  }

 private:
  static constexpr int kSteps = 4096;
  static constexpr int kFineSteps = 2048;
  static constexpr double kFineBelow = 1.0 / 32.0;
  static constexpr int kCoarseEntries = kSteps + 2;  // one behind the end, for sin(psi) = 1
  std::vector<double> values_;                       // the coarse steps, then the fine ones
};

}  // namespace fanbeam::renderer
