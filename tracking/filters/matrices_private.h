// Views of the plain arrays of gaussian.h as matrices. Private: carries the matrix library's types.
#pragma once

#include <Eigen/Dense>

#include "tracking/filters/gaussian.h"

namespace fanbeam::tracking {

// No allocation: the largest sizes are fixed.
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostStates, kMostStates>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostStates, 1>;
using Square = Eigen::Matrix<double, kMostStates, kMostStates, Eigen::RowMajor>;

inline Matrix matrix_of(const StateMatrix& values, int rows, int columns) {
  return Eigen::Map<const Square>(values.data()).topLeftCorner(rows, columns);
}
inline Vector vector_of(const StateVector& values, int size) {
  return Eigen::Map<const Eigen::Matrix<double, kMostStates, 1>>(values.data()).head(size);
}
inline void store(const Matrix& matrix, StateMatrix& values) {
  Eigen::Map<Square>(values.data()).topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
}
inline void store(const Vector& vector, StateVector& values) {
  Eigen::Map<Eigen::Matrix<double, kMostStates, 1>>(values.data()).head(vector.size()) = vector;
}

}  // namespace fanbeam::tracking
