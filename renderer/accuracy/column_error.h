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

  // Mean square over a column's cells of the difference of unrounded grey; of the B-scope, or of
  // the C-scope where the fans have elevation rows and it is larger there. One value per column.
  std::vector<double> mean_square_grey2(const FanSums& one, const FanSums& other) const;

 private:
  const sensors::Sensor& sensor_;
  int sub_columns_;
  bool noise_;
};

}  // namespace fanbeam::renderer
