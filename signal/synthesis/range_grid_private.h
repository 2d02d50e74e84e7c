// A block of chirps of one channel on the oversampled range grid, where paths are spread.
//
// Every path lands in `width` neighbouring cells of every chirp, at a place that moves from chirp
// to chirp: range migration costs nothing and is exact. Cells hold the chirps of the block side by
// side, so that eight chirps are one operation.
#pragma once

#include <vector>

#include "signal/synthesis/phase_run_private.h"
#include "signal/synthesis/spreading_kernel.h"

namespace fanbeam::signal {

// A path on its way through the chirps of a channel.
struct GridPath {
  PhaseRun phase;
  double cell = 0.0;  // of the next chirp, on the grid of G cells; any real number
  double cells_per_chirp = 0.0;
  double bend_rad = 0.0;  // alpha
};

struct GridLayout {
  int cells = 0;
  int chirps = 0;  // a multiple of 8
  int orders = 1;  // grids, 1 to 4; order i is weighted with alpha^i / i!
  // Not 0: a single grid takes the factor 1 + j alpha ((2 k / N)^2 - 1/2). The second derivative of
  // the kernel by cells times this, -(G / (pi N))^2, is the kernel of (2 k / N)^2.
  double derivative_scale = 0.0;

  bool bends() const { return derivative_scale != 0.0; }
};

template <typename Real>
class RangeGrid {
 public:
  RangeGrid(const SpreadingKernel& kernel, const GridLayout& layout);

  void clear();
  // Spreads the path over `chirps` chirps (a multiple of 8, at most the grid's) and moves it on.
  void spread(GridPath& path, int chirps);
  // Adds what lies beyond the last cell to the first ones: the grid is a circle.
  void close();

  // Values of one cell, all chirps of the block.
  const Real* re(int order, int cell) const { return values_.data() + place(order, 0, cell); }
  const Real* im(int order, int cell) const { return values_.data() + place(order, 1, cell); }

 private:
  std::size_t place(int order, int part, int cell) const {
    return ((static_cast<std::size_t>(order) * 2 + static_cast<std::size_t>(part)) *
                static_cast<std::size_t>(layout_.cells + width_) +
            static_cast<std::size_t>(cell)) *
           static_cast<std::size_t>(layout_.chirps);
  }

  int width_;
  GridLayout layout_;
  // Even and odd powers of the first half of the taps; those of the derivative after each tap.
  std::vector<Real> taps_;
  std::vector<Real> values_;
};

extern template class RangeGrid<float>;
extern template class RangeGrid<double>;

}  // namespace fanbeam::signal
