// Standard normal numbers of many neighbouring places at once, for signals of millions of samples.
//
// Number n is a pure function of (key, draw, n), as in core/random.h: 64 numbers come of 16 blocks
// of Philox 4x32-10, those of cells 16 (n / 64) to 16 (n / 64) + 15. Words 0 and 1 of a block make
// one pair, words 2 and 3 another:
//   u = (floor(word / 2) + 1/2) / 2^31,  r = sqrt(-2 ln u),  pair r cos(2 pi w), r sin(2 pi w)
// (G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29, 1958), with both numbers of a pair used:
// numbers 0 to 15 are the cosines of the first pairs, 16 to 31 their sines, 32 to 63 the second
// pairs likewise.
// The 16 blocks lie side by side in vector code.
// Logarithm, sine and cosine are polynomials in float (S. L. Moshier, Cephes: logf, sinf, cosf).
// Accuracy: within 2e-6 of the formula in double where r is above 0.05, 3e-4 below, where u is
// rounded to the next 2^-24. Tails reach 6.6 standard deviations. Always finite.
// The same bits on every level of the instruction set and with any compiler that does not fuse
// products into sums. normal_pair of the same key, cell and draw has the same words: give each use
// a stream of its own.
// Cost: some 3 ns a number on one core with AVX2, a tenth of normal_pair's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/random.h"

namespace fanbeam::core {

// Writes numbers first to first + count - 1. `first` + `count` below 2^64.
void normal_numbers(const RandomKey& key, std::uint32_t draw, std::uint64_t first,
                    std::size_t count, float* numbers);

}  // namespace fanbeam::core
