// Two-way loss between the sensor and points of any height, tabulated for one frame.
//
// The loss in dB along a straight path is its length times the mean specific attenuation between
// the two heights, which does not depend on the length; that mean is tabulated over the height of
// the far end. Heights between steps are interpolated linearly; with 1024 steps the layer tops are
// rounded over a thousandth of the scene's relief. Neglected: the curvature of the Earth within the
// height (1 m at 3.7 km).
#pragma once

#include <algorithm>
#include <vector>

#include "atmosphere/path_attenuation.h"
#include "core/series.h"

namespace fanbeam::renderer {

class PathLossTable {
 public:
  PathLossTable(const atmosphere::PathAttenuation& attenuation, double sensor_height_m,
                double lowest_m, double highest_m);

  bool clear() const noexcept { return clear_; }  // every factor is 1

  // For loops over many points: nepers of two-way power per metre of one-way path at the steps, and
  // the step at or below a height with how far the height is on its way to the next.
  const double* nepers_per_m() const noexcept { return nepers_per_m_.data(); }
  int index_of(double height_m, double& share) const noexcept {
    const double position =
        std::min(kSteps - 1e-9, std::max(0.0, (height_m - lowest_m_) * per_step_));
    const int index = static_cast<int>(position);
    share = position - index;
    return index;
  }

  double two_way_factor(double height_m, double range_m) const noexcept {
    return clear_ ? 1.0 : lossy_factor(height_m, range_m);
  }
  // The same where not all is clear. Without a branch and with an index, not a pointer, it becomes
  // vector code.
  double lossy_factor(double height_m, double range_m) const noexcept {
    double share = 0.0;
    const int index = index_of(height_m, share);
    const double* const table = nepers_per_m_.data();
    const double nepers_per_m = table[index] + (table[index + 1] - table[index]) * share;
    return core::series_decay(nepers_per_m * range_m);
  }

 private:
  static constexpr double kSteps = 1024.0;
  bool clear_ = false;
  double lowest_m_ = 0.0;
  double per_step_ = 0.0;
  std::vector<double> nepers_per_m_;  // of two-way power, per metre of one-way path
};

}  // namespace fanbeam::renderer
