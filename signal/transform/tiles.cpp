#include <algorithm>

#include "core/dispatch.h"
#include "signal/transform/tiles_private.h"

namespace fanbeam::signal {
namespace {

// Rows that are transposed together.
constexpr std::size_t kRows = 4;

// Columns that are gathered together: four cache lines, so that a row's misses overlap. The rows of
// a cube are often a page apart, and their lines compete for the same few places of the cache: one
// line at a time the pass takes twice as long.
template <typename Real>
constexpr std::size_t kStrip = 256 / sizeof(std::complex<Real>);

// Of a strip: where its columns are in memory, and where in the tile, which holds them as rows.
template <typename Real>
struct Strip {
  std::complex<Real>* cells;
  std::size_t stride;  // from row to row of `cells`
  std::size_t rows;
  std::complex<Real>* tile;
  std::size_t pitch;  // from column to column of `tile`
};

// The weights times the cells, transposed. Weighing first, in rows, keeps both loops simple enough
// to become vector code.
template <typename Real>
inline void gather(const Strip<Real>& strip, std::size_t width, const Real* weights) {
  alignas(64) std::complex<Real> block[kRows * kStrip<Real>];
  for (std::size_t r = 0; r < strip.rows; r += kRows) {
    const std::size_t count = std::min(kRows, strip.rows - r);
    for (std::size_t q = 0; q < count; ++q) {
      const Real* const in = reinterpret_cast<const Real*>(strip.cells + (r + q) * strip.stride);
      Real* const out = reinterpret_cast<Real*>(block + q * kStrip<Real>);
      for (std::size_t i = 0; i < 2 * width; ++i) out[i] = in[i] * weights[r + q];
    }
    if (count == kRows) {
      for (std::size_t c = 0; c < width; ++c)
        for (std::size_t q = 0; q < kRows; ++q)
          strip.tile[c * strip.pitch + r + q] = block[q * kStrip<Real> + c];
      continue;
    }
    for (std::size_t c = 0; c < width; ++c)
      for (std::size_t q = 0; q < count; ++q)
        strip.tile[c * strip.pitch + r + q] = block[q * kStrip<Real> + c];
  }
}

template <typename Real>
inline void scatter(const Strip<Real>& strip, std::size_t width) {
  alignas(64) std::complex<Real> block[kRows * kStrip<Real>];
  for (std::size_t r = 0; r < strip.rows; r += kRows) {
    const std::size_t count = std::min(kRows, strip.rows - r);
    if (count == kRows) {
      for (std::size_t c = 0; c < width; ++c)
        for (std::size_t q = 0; q < kRows; ++q)
          block[q * kStrip<Real> + c] = strip.tile[c * strip.pitch + r + q];
    } else {
      for (std::size_t c = 0; c < width; ++c)
        for (std::size_t q = 0; q < count; ++q)
          block[q * kStrip<Real> + c] = strip.tile[c * strip.pitch + r + q];
    }
    for (std::size_t q = 0; q < count; ++q)
      for (std::size_t c = 0; c < width; ++c)
        strip.cells[(r + q) * strip.stride + c] = block[q * kStrip<Real> + c];
  }
}

// A width that is known when compiling makes the difference.
template <typename Real>
inline void gather_any(const Strip<Real>& strip, std::size_t width, const Real* weights) {
  if (width == kStrip<Real>)
    gather(strip, kStrip<Real>, weights);
  else
    gather(strip, width, weights);
}
template <typename Real>
inline void scatter_any(const Strip<Real>& strip, std::size_t width) {
  if (width == kStrip<Real>)
    scatter(strip, kStrip<Real>);
  else
    scatter(strip, width);
}

FANBEAM_HOT(void, gather_strip,
            (const Strip<float>& strip, std::size_t width, const float* weights),
            (strip, width, weights)) {
  gather_any(strip, width, weights);
}
FANBEAM_HOT(void, gather_strip,
            (const Strip<double>& strip, std::size_t width, const double* weights),
            (strip, width, weights)) {
  gather_any(strip, width, weights);
}
FANBEAM_HOT(void, scatter_strip, (const Strip<float>& strip, std::size_t width), (strip, width)) {
  scatter_any(strip, width);
}
FANBEAM_HOT(void, scatter_strip, (const Strip<double>& strip, std::size_t width), (strip, width)) {
  scatter_any(strip, width);
}

template <typename Real>
std::vector<Real> as(const std::vector<double>& weights) {
  std::vector<Real> result(weights.size());
  std::transform(weights.begin(), weights.end(), result.begin(),
                 [](double weight) { return static_cast<Real>(weight); });
  return result;
}

// Columns of the tile start at multiples of 16 bytes, and not a power of two apart.
std::size_t tile_pitch(std::size_t rows) { return rows + rows % 2 + 8; }

}  // namespace

FANBEAM_HOT(void, weigh, (const float* in, const float* weights, float* out, std::size_t count),
            (in, weights, out, count)) {
  for (std::size_t i = 0; i < count; ++i) out[i] = in[i] * weights[i];
}
FANBEAM_HOT(void, weigh, (const double* in, const double* weights, double* out, std::size_t count),
            (in, weights, out, count)) {
  for (std::size_t i = 0; i < count; ++i) out[i] = in[i] * weights[i];
}

template <typename Real>
ColumnTransform<Real>::ColumnTransform(const std::vector<double>& weights, int transform_rows,
                                       int shift, FftDirection direction)
    : weights_(as<Real>(weights)),
      rows_(static_cast<std::size_t>(transform_rows)),
      shift_(static_cast<std::size_t>(shift)),
      column_({.length = transform_rows}, direction),
      strip_({.length = transform_rows,
              .batches = static_cast<int>(kStrip<Real>),
              .distance = static_cast<int>(tile_pitch(rows_))},
             direction) {}

template <typename Real>
void ColumnTransform<Real>::run(const std::complex<Real>* in, std::complex<Real>* out,
                                std::size_t columns, std::size_t first, std::size_t last) const {
  const std::size_t pitch = tile_pitch(rows_);
  // What lies beyond the weighted rows stays zero: the padding of the transform.
  std::vector<std::complex<Real>> gathered(kStrip<Real> * pitch);
  std::vector<std::complex<Real>> lines(kStrip<Real> * pitch);
  const std::size_t upper = rows_ - shift_;  // transformed rows from here on go to the front
  for (std::size_t column = first; column < last; column += kStrip<Real>) {
    const std::size_t width = std::min(kStrip<Real>, last - column);
    gather_strip({const_cast<std::complex<Real>*>(in) + column, columns, weights_.size(),
                  gathered.data(), pitch},
                 width, weights_.data());
    if (width == kStrip<Real>)
      strip_.run(gathered.data(), lines.data());
    else
      for (std::size_t c = 0; c < width; ++c)
        column_.run(gathered.data() + c * pitch, lines.data() + c * pitch);
    scatter_strip({out + shift_ * columns + column, columns, upper, lines.data(), pitch}, width);
    scatter_strip({out + column, columns, shift_, lines.data() + upper, pitch}, width);
  }
}

template class ColumnTransform<float>;
template class ColumnTransform<double>;

}  // namespace fanbeam::signal
