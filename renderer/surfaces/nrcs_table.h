// NRCS over the sine of the grazing angle, made quick for the ray loop.
//
// Holds sigma0(psi) / sin(psi) of any reflectivity model, the factor that the radar equation needs
// per unit of solid angle. Linear interpolation between 4096 even steps of sin(psi), and between
// 2048 finer ones below 1/32, where steep powers bend most. Below 0.001 deg (the first fine step) a
// form that rises towards grazing without end is held. Accuracy: 1e-4 relative from
// 0.1 deg up for Phong-like forms with exponents to 4, as for every row of the shipped library; the
// other models change their law at 0.1 and 60 deg, which costs up to 0.5 % (0.02 dB) right there;
// metal with slopes under 0.05 has lobes steeper than the steps.
// Cost: one comparison and two reads.
#pragma once

#include <algorithm>
#include <vector>

#include "materials/nrcs/nrcs_curve.h"

namespace fanbeam::renderer {

class NrcsTable {
  static constexpr int kSteps = 4096;
  static constexpr int kFineSteps = 2048;
  static constexpr double kFineBelow = 1.0 / 32.0;
  static constexpr int kCoarseEntries = kSteps + 2;  // one behind the end, for sin(psi) = 1

 public:
  explicit NrcsTable(const materials::NrcsCurve& nrcs);

  // 0 for sin_grazing <= 0: the back of a surface does not scatter.
  double sigma0_over_sine(double sin_grazing) const noexcept {
    if (sin_grazing <= 0.0) return 0.0;
    double share = 0.0;
    const double* const value = values_.data() + index_of(sin_grazing, share);
    return value[0] + (value[1] - value[0]) * share;
  }

  // The same in two steps, for loops over many rays: where a sine from 0 up lies between
  // values()[index] and the next one.
  static int index_of(double sin_grazing, double& share) noexcept {
    // Chosen rather than branched to: rays at both kinds of angle follow each other at random.
    const double fine = sin_grazing < kFineBelow ? 1.0 : 0.0;
    const double position =
        std::min(1.0, sin_grazing) * (kSteps + fine * (kFineSteps / kFineBelow - kSteps));
    const int index = static_cast<int>(position);
    share = position - index;
    return index + static_cast<int>(fine * kCoarseEntries);
  }
  const double* values() const noexcept { return values_.data(); }
  static constexpr int kEntries = kCoarseEntries + kFineSteps + 1;  // of values()

  // Over all angles: what is interpolated never exceeds its nodes.
  double largest() const;

  // Largest change at any angle, either way, of sigma0 from `other` to this, in dB: the quotient of
  // two values on straight lines lies between those at their ends. Infinite where only one of the
  // two is dark.
  double largest_change_dB(const NrcsTable& other) const;

 private:
  std::vector<double> values_;  // the coarse steps, then the fine ones
};

}  // namespace fanbeam::renderer
