// Sample covariance R = mean of x x^H of an array's snapshots, plain or smoothed over sub-arrays.
//
// One snapshot, or echoes that keep a fixed phase to each other, give a matrix of rank 1 in which
// sources cannot be told apart. On a uniform line the average over shifted sub-arrays of K
// elements, forwards and conjugate backwards, restores the rank for up to about 2/3 of the
// elements:
//   R = 1 / (2 L) sum over l of (x_l x_l^H + J conj(x_l x_l^H) J),  L = N - K + 1, J the exchange
// Source: S. U. Pillai, B. H. Kwon, "Forward/backward spatial smoothing techniques for coherent
// signal identification", IEEE Trans. ASSP-37, 1989.
//
// Inputs: at least one snapshot, all of one size, finite; K from 1 to that size; elements of a
// smoothed line in order at one pitch. E-RANGE, E-NONFINITE otherwise. The aperture shrinks to K.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace fanbeam::signal {

using Snapshots = std::vector<std::vector<std::complex<double>>>;

struct Covariance {
  int elements = 0;
  std::vector<std::complex<double>> values;  // row * elements + column, Hermitian

  std::complex<double>& at(int row, int column) {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(elements) +
                  static_cast<std::size_t>(column)];
  }
  const std::complex<double>& at(int row, int column) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(elements) +
                  static_cast<std::size_t>(column)];
  }
};

Covariance sample_covariance(const Snapshots& snapshots);
Covariance smoothed_covariance(const Snapshots& snapshots, int subarray_elements);

}  // namespace fanbeam::signal
