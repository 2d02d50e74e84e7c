#include <algorithm>
#include <cmath>

#include "core/dispatch.h"
#include "signal/synthesis/range_grid_private.h"

namespace fanbeam::signal {
namespace {

// Where one group of eight chirps goes.
template <typename Real>
struct Target {
  Real* first;       // first cell's first chirp of the group, order 0, real part
  std::size_t cell;  // from a cell to the next
  std::size_t part;  // from real to imaginary part, and half of that to the next order
  int orders;
};

// Spreads eight values at the place u between cells over W cells.
template <typename Real, int W>
FANBEAM_LANES_INLINE void add_group(const Real* taps, const Lanes<Real>& u,
                                    const ComplexLanes<Real>& value, Real alpha,
                                    const Target<Real>& target) {
  constexpr int kHalf = (W + 4) / 2;  // powers of each parity: degree W + 3
  const Lanes<Real> u2 = u * u;
  for (int tap = 0; tap < W / 2; ++tap) {
    const Real* even = taps + tap * 2 * kHalf;
    const Real* odd = even + kHalf;
    Lanes<Real> e = u2 * even[kHalf - 1] + even[kHalf - 2];
    Lanes<Real> o = u2 * odd[kHalf - 1] + odd[kHalf - 2];
    for (int i = kHalf - 3; i >= 0; --i) {
      e = e * u2 + even[i];
      o = o * u2 + odd[i];
    }
    o = o * u;
    const Lanes<Real> near = e + o, far = e - o;
    Real* at_near = target.first + static_cast<std::size_t>(tap) * target.cell;
    Real* at_far = target.first + static_cast<std::size_t>(W - 1 - tap) * target.cell;
    ComplexLanes<Real> weighted = value;
    for (int order = 0; order < target.orders; ++order) {
      const std::size_t shift = static_cast<std::size_t>(order) * 2 * target.part;
      add_to<Real>(at_near + shift, near * weighted.re);
      add_to<Real>(at_near + shift + target.part, near * weighted.im);
      add_to<Real>(at_far + shift, far * weighted.re);
      add_to<Real>(at_far + shift + target.part, far * weighted.im);
      const Real next = alpha / static_cast<Real>(order + 1);
      weighted.re = weighted.re * next;
      weighted.im = weighted.im * next;
    }
  }
}

template <typename Real, int W>
FANBEAM_LANES_INLINE void spread_groups(const Real* taps, GridPath& path, int groups, int cells,
                                        Real* values, std::size_t cell, std::size_t part,
                                        int orders) {
  const Lanes<Real> numbers = {0, 1, 2, 3, 4, 5, 6, 7};
  MovingRun run(path.phase);
  for (int group = 0; group < groups; ++group) {
    ComplexLanes<Real> value;
    value.re = __builtin_convertvector(run.values.re, Lanes<Real>);
    value.im = __builtin_convertvector(run.values.im, Lanes<Real>);
    // Around the circle, so that the first cell written is one of the grid's.
    const double turned = path.cell - 0.5 * W;
    const double begin = turned - cells * std::floor(turned / cells);
    const double end = begin + (kLanes - 1) * path.cells_per_chirp;
    const int first = static_cast<int>(std::ceil(std::min(begin, end)));
    const int last = static_cast<int>(std::ceil(std::max(begin, end)));
    for (int base = first; base <= last; ++base) {
      const Lanes<Real> u = static_cast<Real>(2.0 * (base - begin) - 1.0) -
                            numbers * static_cast<Real>(2.0 * path.cells_per_chirp);
      const int row = base < 0 ? base + cells : base >= cells ? base - cells : base;
      const Target<Real> target{
          values + static_cast<std::size_t>(row) * cell + static_cast<std::size_t>(group * kLanes),
          cell, part, orders};
      const auto alpha = static_cast<Real>(path.bend_rad);
      if (first == last) {
        add_group<Real, W>(taps, u, value, alpha, target);
        break;
      }
      ComplexLanes<Real> kept = value;
      Lanes<Real> inside = u;
      for (int lane = 0; lane < kLanes; ++lane)
        if (static_cast<int>(std::ceil(begin + lane * path.cells_per_chirp)) != base)
          inside[lane] = kept.re[lane] = kept.im[lane] = Real(0);
      add_group<Real, W>(taps, inside, kept, alpha, target);
    }
    run.advance();
    path.cell += kLanes * path.cells_per_chirp;
  }
  run.put_back(path.phase);
}

// One entry for every width and precision, each compiled for every level.
#define FANBEAM_SPREAD(name, Real, W)                                                    \
  FANBEAM_HOT FANBEAM_INLINE_ALL void name(const Real* taps, GridPath& path, int groups, \
                                           int cells, Real* values, std::size_t cell,    \
                                           std::size_t part, int orders) {               \
    spread_groups<Real, W>(taps, path, groups, cells, values, cell, part, orders);       \
  }
FANBEAM_SPREAD(spread_float_4, float, 4)
FANBEAM_SPREAD(spread_float_6, float, 6)
FANBEAM_SPREAD(spread_float_8, float, 8)
FANBEAM_SPREAD(spread_double_8, double, 8)
FANBEAM_SPREAD(spread_double_10, double, 10)
FANBEAM_SPREAD(spread_double_12, double, 12)
#undef FANBEAM_SPREAD

template <typename Real>
using Spread = void (*)(const Real*, GridPath&, int, int, Real*, std::size_t, std::size_t, int);

Spread<float> spread_of(int width, float) {
  return width <= 4 ? spread_float_4 : width <= 6 ? spread_float_6 : spread_float_8;
}
Spread<double> spread_of(int width, double) {
  return width <= 8 ? spread_double_8 : width <= 10 ? spread_double_10 : spread_double_12;
}

}  // namespace

template <typename Real>
RangeGrid<Real>::RangeGrid(const SpreadingKernel& kernel, int cells, int chirps, int orders)
    : width_(kernel.width()), cells_(cells), chirps_(chirps), orders_(orders) {
  const int powers = kernel.degree() + 1;
  for (int tap = 0; tap < width_ / 2; ++tap)
    for (const int parity : {0, 1})
      for (int power = parity; power < powers; power += 2)
        taps_.push_back(
            static_cast<Real>(kernel.taps()[static_cast<std::size_t>(tap * powers + power)]));
  values_.resize(place(orders, 0, 0));
}

template <typename Real>
void RangeGrid<Real>::clear() {
  std::fill(values_.begin(), values_.end(), Real(0));
}

template <typename Real>
void RangeGrid<Real>::spread(GridPath& path, int chirps) {
  spread_of(width_, Real())(taps_.data(), path, chirps / kLanes, cells_, values_.data(),
                            static_cast<std::size_t>(chirps_), place(0, 1, 0), orders_);
}

template <typename Real>
void RangeGrid<Real>::close() {
  for (int order = 0; order < orders_; ++order)
    for (int part = 0; part < 2; ++part)
      for (int cell = 0; cell < width_; ++cell) {
        Real* to = values_.data() + place(order, part, cell);
        const Real* from = values_.data() + place(order, part, cells_ + cell);
        for (int chirp = 0; chirp < chirps_; ++chirp) to[chirp] += from[chirp];
      }
}

template class RangeGrid<float>;
template class RangeGrid<double>;

}  // namespace fanbeam::signal
