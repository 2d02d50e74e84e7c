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
  double bend_rad = 0.0;  // weight of the orders above 0: alpha
};

template <typename Real>
class RangeGrid {
 public:
  // `chirps` is a multiple of 8; `orders` 1 to 4: as many grids, order i weighted with
  // alpha^i / i!.
  RangeGrid(const SpreadingKernel& kernel, int cells, int chirps, int orders);

  void clear();
  // Spreads the path over `chirps` chirps (a multiple of 8, at most the grid's) and moves it on.
  void spread(GridPath& path, int chirps);
  // Adds what lies beyond the last cell to the first ones: the grid is a circle.
  void close();

  int cells() const { return cells_; }
  // Values of one cell, all chirps of the block.
  const Real* re(int order, int cell) const { return values_.data() + place(order, 0, cell); }
  const Real* im(int order, int cell) const { return values_.data() + place(order, 1, cell); }

 private:
  std::size_t place(int order, int part, int cell) const {
    return ((static_cast<std::size_t>(order) * 2 + static_cast<std::size_t>(part)) *
                static_cast<std::size_t>(cells_ + width_) +
            static_cast<std::size_t>(cell)) *
           static_cast<std::size_t>(chirps_);
  }

  int width_, cells_, chirps_, orders_;
  std::vector<Real> taps_;  // even and odd powers of the first half of the taps
  std::vector<Real> values_;
};

extern template class RangeGrid<float>;
extern template class RangeGrid<double>;

}  // namespace fanbeam::signal
