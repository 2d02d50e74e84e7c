// How far two pictures of one fan are apart, column by column, in displayed grey.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

class ColumnError {
 public:
  // `common`: what both pictures have as well, such as the echo of rain; shaped like the fans that
  // are compared. `noise`: so is the receiver's mean noise power, as a display shows it.
  ColumnError(const sensors::Sensor& sensor, int sub_columns_per_column, const FanSums& common,
              bool noise);

  // Mean squares over a column's cells of the difference of unrounded grey, one value per column.
  struct Squares {
    std::vector<double> bscope_grey2, cscope_grey2;  // the latter all 0 without elevation rows
  };
  Squares between(const FanSums& one, const FanSums& other) const;

 private:
  std::vector<double> bscope_W(const FanSums& fan) const;
  std::vector<double> cscope_W_m3(const FanSums& fan) const;

  const sensors::Sensor& sensor_;
  int sub_columns_;
  std::vector<double> common_W_, common_W_m3_;
};

}  // namespace fanbeam::renderer
