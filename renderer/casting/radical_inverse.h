// Low-discrepancy places for passes that follow each other.
#pragma once

namespace fanbeam::renderer {

// Digits of `index` in `base`, mirrored behind the point: 0, 1/2, 1/4, 3/4, 1/8 ... in base 2, ever
// finer even spacings. In [0, 1).
inline double radical_inverse(int index, int base) {
  double value = 0.0;
  for (double digit = 1.0 / base; index > 0; index /= base, digit /= base)
    value += digit * (index % base);
  return value;
}

}  // namespace fanbeam::renderer
