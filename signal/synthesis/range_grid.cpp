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

// A tap and its mirror image.
template <typename Real>
struct TapPair {
  Lanes<Real> near, far;
};

// Even powers are the first Count coefficients, odd ones the next.
template <typename Real, int Count>
FANBEAM_LANES_INLINE void evaluate(const Real* even, const Lanes<Real>& u, const Lanes<Real>& u2,
                                   TapPair<Real>& taps) {
  const Real* odd = even + Count;
  Lanes<Real> e = u2 * even[Count - 1] + even[Count - 2];
  Lanes<Real> o = u2 * odd[Count - 1] + odd[Count - 2];
  for (int i = Count - 3; i >= 0; --i) {
    e = e * u2 + even[i];
    o = o * u2 + odd[i];
  }
  o = o * u;
  taps.near = e + o;
  taps.far = e - o;
}

// Powers of each parity in a tap, of degree W + 3, and in its second derivative.
template <int W>
constexpr int kPowers = (W + 4) / 2;
template <int W>
constexpr int kBentPowers = kPowers<W> - 1;

// Spreads eight values at the place u between cells over W cells.
template <typename Real, int W>
FANBEAM_LANES_INLINE void add_group(const Real* taps, const Lanes<Real>& u,
                                    const ComplexLanes<Real>& value, Real alpha,
                                    const Target<Real>& target) {
  const Lanes<Real> u2 = u * u;
  for (int tap = 0; tap < W / 2; ++tap) {
    TapPair<Real> kernel;
    evaluate<Real, kPowers<W>>(taps + tap * 2 * kPowers<W>, u, u2, kernel);
    Real* at_near = target.first + static_cast<std::size_t>(tap) * target.cell;
    Real* at_far = target.first + static_cast<std::size_t>(W - 1 - tap) * target.cell;
    ComplexLanes<Real> weighted = value;
    for (int order = 0; order < target.orders; ++order) {
      const std::size_t shift = static_cast<std::size_t>(order) * 2 * target.part;
      add_to<Real>(at_near + shift, kernel.near * weighted.re);
      add_to<Real>(at_near + shift + target.part, kernel.near * weighted.im);
      add_to<Real>(at_far + shift, kernel.far * weighted.re);
      add_to<Real>(at_far + shift + target.part, kernel.far * weighted.im);
      const Real next = alpha / static_cast<Real>(order + 1);
      weighted.re = weighted.re * next;
      weighted.im = weighted.im * next;
    }
  }
}

// The same with the bend to first order: 1 + j alpha ((2 k / N)^2 - 1/2).
template <typename Real, int W>
FANBEAM_LANES_INLINE void add_bent_group(const Real* taps, const Lanes<Real>& u,
                                         const ComplexLanes<Real>& value, Real alpha,
                                         const Target<Real>& target) {
  const Lanes<Real> u2 = u * u;
  const Lanes<Real> bent_re = value.re * alpha, bent_im = value.im * alpha;
  const Lanes<Real> re = value.re + bent_im * Real(0.5), im = value.im - bent_re * Real(0.5);
  for (int tap = 0; tap < W / 2; ++tap) {
    TapPair<Real> kernel, derivative;
    const Real* coefficients = taps + tap * 2 * (kPowers<W> + kBentPowers<W>);
    evaluate<Real, kPowers<W>>(coefficients, u, u2, kernel);
    evaluate<Real, kBentPowers<W>>(coefficients + 2 * kPowers<W>, u, u2, derivative);
    Real* at_near = target.first + static_cast<std::size_t>(tap) * target.cell;
    Real* at_far = target.first + static_cast<std::size_t>(W - 1 - tap) * target.cell;
    add_to<Real>(at_near, kernel.near * re - derivative.near * bent_im);
    add_to<Real>(at_near + target.part, kernel.near * im + derivative.near * bent_re);
    add_to<Real>(at_far, kernel.far * re - derivative.far * bent_im);
    add_to<Real>(at_far + target.part, kernel.far * im + derivative.far * bent_re);
  }
}

// Where a path's chirps go in the grid.
template <typename Real>
struct Chirps {
  int groups;
  int cells;
  Real* values;
  std::size_t cell, part;  // as in Target
  int orders;
};

template <typename Real, int W, bool Bent>
FANBEAM_LANES_INLINE void spread_groups(const Real* taps, GridPath& path,
                                        const Chirps<Real>& chirps) {
  const Lanes<Real> numbers = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto alpha = static_cast<Real>(path.bend_rad);
  const int cells = chirps.cells;
  MovingRun run(path.phase);
  for (int group = 0; group < chirps.groups; ++group) {
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
      Lanes<Real> u = static_cast<Real>(2.0 * (base - begin) - 1.0) -
                      numbers * static_cast<Real>(2.0 * path.cells_per_chirp);
      const int row = base < 0 ? base + cells : base >= cells ? base - cells : base;
      const Target<Real> target{chirps.values + static_cast<std::size_t>(row) * chirps.cell +
                                    static_cast<std::size_t>(group * kLanes),
                                chirps.cell, chirps.part, chirps.orders};
      ComplexLanes<Real> kept = value;
      if (first != last)
        for (int lane = 0; lane < kLanes; ++lane)
          if (static_cast<int>(std::ceil(begin + lane * path.cells_per_chirp)) != base)
            u[lane] = kept.re[lane] = kept.im[lane] = Real(0);
      if constexpr (Bent)
        add_bent_group<Real, W>(taps, u, kept, alpha, target);
      else
        add_group<Real, W>(taps, u, kept, alpha, target);
    }
    run.advance();
    path.cell += kLanes * path.cells_per_chirp;
  }
  run.put_back(path.phase);
}

// One entry for every width, precision and way of bending, each compiled for every level.
#define FANBEAM_SPREAD(name, Real, W)                                                            \
  FANBEAM_HOT(void, name, (const Real* taps, GridPath& path, const Chirps<Real>& chirps),        \
              (taps, path, chirps)) {                                                            \
    spread_groups<Real, W, false>(taps, path, chirps);                                           \
  }                                                                                              \
  FANBEAM_HOT(void, name##_bent, (const Real* taps, GridPath& path, const Chirps<Real>& chirps), \
              (taps, path, chirps)) {                                                            \
    spread_groups<Real, W, true>(taps, path, chirps);                                            \
  }
FANBEAM_SPREAD(spread_float_4, float, 4)
FANBEAM_SPREAD(spread_float_6, float, 6)
FANBEAM_SPREAD(spread_float_8, float, 8)
FANBEAM_SPREAD(spread_double_8, double, 8)
FANBEAM_SPREAD(spread_double_10, double, 10)
FANBEAM_SPREAD(spread_double_12, double, 12)
#undef FANBEAM_SPREAD

template <typename Real>
using Spread = void (*)(const Real*, GridPath&, const Chirps<Real>&);

Spread<float> spread_of(int width, bool bent, float) {
  if (bent)
    return width <= 4   ? spread_float_4_bent
           : width <= 6 ? spread_float_6_bent
                        : spread_float_8_bent;
  return width <= 4 ? spread_float_4 : width <= 6 ? spread_float_6 : spread_float_8;
}
Spread<double> spread_of(int width, bool bent, double) {
  if (bent)
    return width <= 8    ? spread_double_8_bent
           : width <= 10 ? spread_double_10_bent
                         : spread_double_12_bent;
  return width <= 8 ? spread_double_8 : width <= 10 ? spread_double_10 : spread_double_12;
}

// Powers of one parity.
template <typename Real>
void append_half(const std::vector<double>& powers, std::size_t parity, std::vector<Real>& taps) {
  for (std::size_t power = parity; power < powers.size(); power += 2)
    taps.push_back(static_cast<Real>(powers[power]));
}

// Of a tap in u, which runs twice as fast as the cells.
std::vector<double> second_derivative(const std::vector<double>& powers, double scale) {
  std::vector<double> derivative;
  for (std::size_t power = 2; power < powers.size(); ++power)
    derivative.push_back(4.0 * scale * static_cast<double>(power * (power - 1)) * powers[power]);
  return derivative;
}

}  // namespace

template <typename Real>
RangeGrid<Real>::RangeGrid(const SpreadingKernel& kernel, const GridLayout& layout)
    : width_(kernel.width()), layout_(layout) {
  const int count = kernel.degree() + 1;
  for (int tap = 0; tap < width_ / 2; ++tap) {
    const auto first = kernel.taps().begin() + tap * count;
    const std::vector<double> powers(first, first + count);
    for (const std::size_t parity : {0U, 1U}) append_half(powers, parity, taps_);
    if (!layout.bends()) continue;
    const std::vector<double> bent = second_derivative(powers, layout.derivative_scale);
    for (const std::size_t parity : {0U, 1U}) append_half(bent, parity, taps_);
  }
  values_.resize(place(layout.orders, 0, 0));
}

template <typename Real>
void RangeGrid<Real>::clear() {
  std::fill(values_.begin(), values_.end(), Real(0));
}

template <typename Real>
void RangeGrid<Real>::spread(GridPath& path, int chirps) {
  spread_of(width_, layout_.bends(), Real())(
      taps_.data(), path,
      {chirps / kLanes, layout_.cells, values_.data(), static_cast<std::size_t>(layout_.chirps),
       place(0, 1, 0), layout_.orders});
}

template <typename Real>
void RangeGrid<Real>::close() {
  for (int order = 0; order < layout_.orders; ++order)
    for (int part = 0; part < 2; ++part)
      for (int cell = 0; cell < width_; ++cell) {
        Real* to = values_.data() + place(order, part, cell);
        const Real* from = values_.data() + place(order, part, layout_.cells + cell);
        for (int chirp = 0; chirp < layout_.chirps; ++chirp) to[chirp] += from[chirp];
      }
}

template class RangeGrid<float>;
template class RangeGrid<double>;

}  // namespace fanbeam::signal
