// How far two pictures of one fan are apart, column by column, in displayed grey.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

class ColumnError {
 public:
  // `noise`: the receiver's mean noise power is in both pictures, as a display shows them.
  ColumnError(const sensors::Sensor& sensor, int sub_columns_per_column, bool noise)
      : sensor_(sensor), sub_columns_(sub_columns_per_column), noise_(noise) {}

  // Mean squares over a column's cells of the difference of unrounded grey, one value per column.
  struct Squares {
    std::vector<double> bscope_grey2, cscope_grey2;  // the latter all 0 without elevation rows
  };
  Squares between(const FanSums& one, const FanSums& other) const;

 private:
  const sensors::Sensor& sensor_;
  int sub_columns_;
  bool noise_;
};

}  // namespace fanbeam::renderer
