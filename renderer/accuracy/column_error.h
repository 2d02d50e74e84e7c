// How far two pictures of one view are apart, column by column, in displayed grey. Their fans may have
// different sub-columns.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

class ColumnError {
 public:
  // `noise`: the receiver's mean noise power is in both pictures, as a display shows them.
  // `drawn_from_m`: where it is above 0, C-scopes of mode flat_earth or shadow are drawn from both
  // B-scopes, of an antenna that high above the ground (sensors/shadow/shadow_cscope.h).
  ColumnError(const sensors::Sensor& sensor, bool noise, double drawn_from_m = 0.0);

  // What both pictures have as well, such as the echo of rain.
  void put_under(const FanSums& common);

  // Mean squares over a column's cells of the difference of unrounded grey, one value per column.
  struct Squares {
    std::vector<double> bscope_grey2, cscope_grey2;  // the latter all 0 without a C-scope
    // Of the C-scope without the obstacles that mode shadow raises; the same as that in other modes. More
    // samples make it smaller.
    std::vector<double> unraised_grey2;
  };
  Squares between(const FanSums& one, const FanSums& other) const;

 private:
  std::vector<double> image(const std::vector<double>& sums, int bins, const FanSums& fan) const;
  bool raises() const;
  std::vector<double> cscope_grey(const FanSums& fan, const std::vector<double>& received_W,
                                  bool raised) const;

  const sensors::Sensor& sensor_;
  double noise_W_, noise_W_m3_, drawn_from_m_;
  std::vector<double> common_W_, common_W_m3_;  // empty for nothing
};

}  // namespace fanbeam::renderer
