// Eight numbers that are worked on at once. A vector type of GCC and Clang: sums and products of
// elements, so results are those of a loop over eight numbers at any level of the instruction set.
// Only for variables inside a function: how such a value is aligned and passed depends on the level.
// What is kept in memory is plain arrays.
#pragma once

#include <cstring>

#define FANBEAM_LANES_INLINE inline __attribute__((always_inline))

namespace fanbeam::signal {

inline constexpr int kLanes = 8;

template <typename Real>
struct LanesOf;
template <>
struct LanesOf<float> {
  using Type [[gnu::vector_size(32)]] = float;
};
template <>
struct LanesOf<double> {
  using Type [[gnu::vector_size(64)]] = double;
};

template <typename Real>
using Lanes = typename LanesOf<Real>::Type;

template <typename Real>
struct ComplexLanes {
  Lanes<Real> re, im;
};

// A value's lanes in memory.
struct StoredLanes {
  double re[kLanes], im[kLanes];
};

template <typename Real>
FANBEAM_LANES_INLINE void load(const Real* from, Lanes<Real>& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}
template <typename Real>
FANBEAM_LANES_INLINE void add_to(Real* to, const Lanes<Real>& lanes) {
  Lanes<Real> sum;
  std::memcpy(&sum, to, sizeof(sum));
  sum += lanes;
  std::memcpy(to, &sum, sizeof(sum));
}

FANBEAM_LANES_INLINE void load(const StoredLanes& from, ComplexLanes<double>& lanes) {
  load<double>(from.re, lanes.re);
  load<double>(from.im, lanes.im);
}
FANBEAM_LANES_INLINE void store(const ComplexLanes<double>& lanes, StoredLanes& to) {
  std::memcpy(to.re, &lanes.re, sizeof(to.re));
  std::memcpy(to.im, &lanes.im, sizeof(to.im));
}

// a *= b.
template <typename Real>
FANBEAM_LANES_INLINE void multiply_by(ComplexLanes<Real>& a, const ComplexLanes<Real>& b) {
  const Lanes<Real> re = a.re * b.re - a.im * b.im;
  a.im = a.re * b.im + a.im * b.re;
  a.re = re;
}

}  // namespace fanbeam::signal
