// Low-discrepancy places for passes that follow each other.
#pragma once

#include <cmath>
#include <cstdint>

namespace fanbeam::renderer {

// Digits of `index` in `base`, mirrored behind the point: 0, 1/2, 1/4, 3/4, 1/8 ... in base 2, ever
// finer even spacings. In [0, 1).
inline double radical_inverse(int index, int base) {
  double value = 0.0;
  for (double digit = 1.0 / base; index > 0; index /= base, digit /= base)
    value += digit * (index % base);
  return value;
}

// Where pass number `pass` looks inside every sub-column and every step in elevation: Halton points
// keep passes apart in both. Pass 0 is in the middle of a step.
struct PassPlace {
  std::uint32_t azimuth_shift;  // in parts of 2^32
  double elevation;             // in [0, 1)
};
inline PassPlace pass_place(int pass) {
  return {static_cast<std::uint32_t>(radical_inverse(pass, 2) * 0x1p32),
          std::fmod(0.5 + radical_inverse(pass, 3), 1.0)};
}

}  // namespace fanbeam::renderer
