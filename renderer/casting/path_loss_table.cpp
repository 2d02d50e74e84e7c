#include "renderer/casting/path_loss_table.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

PathLossTable::PathLossTable(const atmosphere::PathAttenuation& attenuation, double sensor_height_m,
                             double lowest_m, double highest_m)
    : clear_(attenuation.is_clear()), lowest_m_(lowest_m) {
  const double step_m = std::max((highest_m - lowest_m) / kSteps, 1e-6);
  per_step_ = 1.0 / step_m;
  if (clear_) return;
  const double two_way_nepers_per_dB = 0.2 * std::log(10.0);
  for (int i = 0; i <= static_cast<int>(kSteps); ++i)
    nepers_per_m_.push_back(two_way_nepers_per_dB *
                            attenuation.one_way_dB(sensor_height_m, lowest_m + step_m * i, 1.0));
}

}  // namespace fanbeam::renderer
