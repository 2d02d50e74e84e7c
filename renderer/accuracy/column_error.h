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
  ColumnError(const sensors::Sensor& sensor, bool noise);

  // What both pictures have as well, such as the echo of rain.
  void put_under(const FanSums& common);

  // Mean squares over a column's cells of the difference of unrounded grey, one value per column.
  struct Squares {
    std::vector<double> bscope_grey2, cscope_grey2;  // the latter all 0 without elevation rows
  };
  Squares between(const FanSums& one, const FanSums& other) const;

 private:
  std::vector<double> image(const std::vector<double>& sums, int bins, const FanSums& fan) const;

  const sensors::Sensor& sensor_;
  double noise_W_, noise_W_m3_;
  std::vector<double> common_W_, common_W_m3_;  // empty for nothing
};

}  // namespace fanbeam::renderer
