// Two-way loss between the sensor and points of any height, tabulated for one frame.
//
// The loss in dB along a straight path is its length times the mean specific attenuation between
// the two heights, which does not depend on the length; that mean is tabulated over the height of
// the far end. Heights between steps are interpolated linearly; with 1024 steps the layer tops are
// rounded over a thousandth of the scene's relief. Neglected: the curvature of the Earth within the
// height (1 m at 3.7 km).
#pragma once

#include <cmath>
#include <vector>

#include "atmosphere/path_attenuation.h"

namespace fanbeam::renderer {

class PathLossTable {
 public:
  PathLossTable(const atmosphere::PathAttenuation& attenuation, double sensor_height_m,
                double lowest_m, double highest_m);

  bool clear() const noexcept { return clear_; }  // every factor is 1

  // For vector loops: nepers of two-way power per metre of one-way path, at `lowest_m` plus whole
  // steps; one entry more than kSteps.
  const double* nepers_per_m() const noexcept { return nepers_per_m_.data(); }
  double lowest_m() const noexcept { return lowest_m_; }
  double steps_per_m() const noexcept { return per_step_; }
  static constexpr double kSteps = 1024.0;

  double two_way_factor(double height_m, double range_m) const noexcept {
    if (clear_) return 1.0;
    const double position =
        std::fmin(std::fmax((height_m - lowest_m_) * per_step_, 0.0), kSteps - 1e-9);
    const auto index = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(index);
    const double nepers_per_m =
        nepers_per_m_[index] * (1.0 - share) + nepers_per_m_[index + 1] * share;
    return decay(nepers_per_m * range_m);
  }

 private:
  // exp(-x); in the common case of little loss by its series, whose first omitted term is below
  // 2e-8 there.
  static double decay(double x) noexcept {
    if (x > 0.25) return std::exp(-x);
    constexpr double k2 = 1.0 / 2, k3 = 1.0 / 6, k4 = 1.0 / 24, k5 = 1.0 / 120, k6 = 1.0 / 720;
    return 1.0 - x * (1.0 - x * (k2 - x * (k3 - x * (k4 - x * (k5 - x * k6)))));
  }

  bool clear_ = false;
  double lowest_m_ = 0.0;
  double per_step_ = 0.0;
  std::vector<double> nepers_per_m_;  // of two-way power, per metre of one-way path
};

}  // namespace fanbeam::renderer
