// A cube of range, Doppler and angle laid flat: power over two of its axes.
//
//   range-Doppler   row: Doppler cell, column: range cell; over all angles (or channels)
//   range-azimuth   row: angle cell,   column: range cell; over all Doppler cells
//
// `max` keeps the strongest cell along the axis that goes, `sum` adds their powers, in the order of
// the cells and in double. Over channels before the angle transform, `sum` is the non-coherent
// integration.
#pragma once

#include <cstddef>
#include <vector>

#include "signal/cube.h"

namespace fanbeam::signal {

enum class Projection { max, sum };

struct PowerMap {
  int rows = 0;
  int columns = 0;
  std::vector<double> values_W;  // row * columns + column

  PowerMap() = default;
  PowerMap(int its_rows, int its_columns)
      : rows(its_rows),
        columns(its_columns),
        values_W(static_cast<std::size_t>(its_rows) * static_cast<std::size_t>(its_columns)) {}

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  double& at(int row, int column) { return values_W[index(row, column)]; }
  double at(int row, int column) const { return values_W[index(row, column)]; }
};

template <typename Real>
PowerMap range_doppler_map(const Cube<Real>& cube, Projection projection);

template <typename Real>
PowerMap range_azimuth_map(const Cube<Real>& cube, Projection projection);

}  // namespace fanbeam::signal
