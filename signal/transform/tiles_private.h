// Transforms along an axis of an array whose values are not neighbours, in tiles that stay in the
// cache: a few columns are gathered under their weights and transposed, transformed as neighbours,
// and written back, whole cache lines each way.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "signal/fourier/fft.h"

namespace fanbeam::signal {

// out[i] = in[i] * weights[i]. The weights of complex values are stored twice each, so that the
// loop is a plain product.
void weigh(const float* in, const float* weights, float* out, std::size_t count);
void weigh(const double* in, const double* weights, double* out, std::size_t count);

// Weights for `weigh`, scaled by `scale`.
template <typename Real>
std::vector<Real> doubled_weights(const std::vector<double>& weights, double scale) {
  std::vector<Real> result;
  result.reserve(2 * weights.size());
  for (const double weight : weights)
    result.insert(result.end(), 2, static_cast<Real>(weight * scale));
  return result;
}

template <typename Real>
class ColumnTransform {
 public:
  // `weights` has one per input row; rows beyond it are zero up to `transform_rows`. Output row k
  // of the transform goes to row (k + shift) mod transform_rows.
  ColumnTransform(const std::vector<double>& weights, int transform_rows, int shift,
                  FftDirection direction);

  // `in` holds rows of `columns` neighbours, `out` too; they may be the same when the counts of
  // rows are. Works on columns [first, last).
  void run(const std::complex<Real>* in, std::complex<Real>* out, std::size_t columns,
           std::size_t first, std::size_t last) const;

 private:
  std::vector<Real> weights_;
  std::size_t rows_;
  std::size_t shift_;
  Fft<Real> column_, strip_;  // one, and as many as are gathered together
};

extern template class ColumnTransform<float>;
extern template class ColumnTransform<double>;

}  // namespace fanbeam::signal
