// NRCS over the sine of the grazing angle, made quick for the ray loop.
//
// Holds sigma0(psi) / sin(psi) of any reflectivity model, the factor that the radar equation needs
// per unit of solid angle. Linear interpolation between nodes in three runs of even steps of
// sin(psi): 1/65536 below 1/32, where steep powers bend most; 1/4096 from there on; and 1/524288
// in the last 5 deg before the normal, where the sine hardly moves with the angle (the last step is
// 0.1 deg, no other one above 0.16). Below 0.001 deg (the first step) a form that rises towards
// grazing without end is held. Accuracy: 1e-4 relative from 0.1 deg up for Phong-like forms with
// exponents to 4, as for every row of the shipped library; the other models change their law at 0.1
// and 60 deg, which costs up to 0.5 % (0.02 dB) right there; 0.05 dB for metal with slopes under
// 0.03 and for tables that change by less than 2 dB per degree, 0.5 dB at 15 dB per degree.
// Cost: three comparisons and two reads.
#pragma once

#include <algorithm>
#include <vector>

#include "materials/nrcs/nrcs_curve.h"

namespace fanbeam::renderer {

class NrcsTable {
  // The runs, by the numbers of their first nodes and nodes per unit of the sine.
  static constexpr int kCoarse = 2048, kSteep = 6000;
  static constexpr double kFinePer = 65536.0, kCoarsePer = 4096.0, kSteepPer = 524288.0;
  static constexpr double kCoarseFrom = kCoarse / kFinePer;
  static constexpr double kSteepFrom = kCoarseFrom + (kSteep - kCoarse) / kCoarsePer;
  static constexpr double kCoarseAt0 = kCoarse - kCoarsePer * kCoarseFrom;
  static constexpr double kSteepAt0 = kSteep - kSteepPer * kSteepFrom;
  static constexpr int kLast = static_cast<int>(kSteepPer + kSteepAt0);  // at the normal

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
    // The node rises along three straight lines, chosen rather than branched to: rays at all angles
    // follow each other at random. The limit, also that of a NaN, stands in the middle because GCC
    // makes a path of its own of a constant at the end.
    const double fine = sin_grazing * kFinePer;
    const double coarse = sin_grazing * kCoarsePer + kCoarseAt0;
    const double steep = sin_grazing * kSteepPer + kSteepAt0;
    const double position =
        std::min(std::min(static_cast<double>(kLast), std::max(coarse, steep)), fine);
    const int index = static_cast<int>(position);
    share = position - index;
    return index;
  }
  const double* values() const noexcept { return values_.data(); }
  static constexpr int kEntries = kLast + 2;  // of values(), one behind the normal

  // Over all angles: what is interpolated never exceeds its nodes.
  double largest() const;

  // Largest change at any angle, either way, of sigma0 from `other` to this, in dB: the quotient of
  // two values on straight lines lies between those at their ends. Infinite where only one of the
  // two is dark.
  double largest_change_dB(const NrcsTable& other) const;

 private:
  static double sine_of(int index);

  std::vector<double> values_;  // by node
};

}  // namespace fanbeam::renderer
