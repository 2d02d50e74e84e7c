#include "core/random.h"

#include <Random123/philox.h>

#include <cmath>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/series.h"

namespace fanbeam::core {

std::array<std::uint32_t, 4> philox_block(std::array<std::uint32_t, 4> counter,
                                          std::array<std::uint32_t, 2> key) {
  const r123::Philox4x32 generator;
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k = {{key[0], key[1]}};
  const r123::Philox4x32::ctr_type r = generator(c, k);
  return {r[0], r[1], r[2], r[3]};
}

std::array<std::uint32_t, 4> random_words(const RandomKey& key, std::uint64_t cell,
                                          std::uint32_t draw) {
  // Cell, draw and the lower half of the frame make the counter.
  return philox_block({static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell >> 32U),
                       draw, static_cast<std::uint32_t>(key.frame)},
                      philox_key(key));
}

std::array<double, 2> normal_pair(const RandomKey& key, std::uint64_t cell, std::uint32_t draw) {
  const auto words = random_words(key, cell, draw);
  const double radius = std::sqrt(-2.0 * std::log(uniform_from(words[0])));
  const double angle = 2.0 * kPi * uniform_from(words[1]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

namespace {

using Words = std::array<std::uint32_t, 2>;

// Multiplies by the first `Used` uniform numbers of one draw.
template <int Used>
inline void multiply(const Words& key_words, std::uint32_t frame, std::uint32_t draw,
                     std::uint64_t first, std::size_t cells, double* products) {
  const r123::Philox4x32 generator;
  const r123::Philox4x32::key_type key = {{key_words[0], key_words[1]}};
  for (std::size_t i = 0; i < cells; ++i) {
    const std::uint64_t cell = first + i;
    const r123::Philox4x32::ctr_type words = generator(
        {{static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell >> 32U), draw, frame}},
        key);
    double product = products[i] * uniform_from(words[0]);
    if constexpr (Used > 1) product *= uniform_from(words[1]);
    if constexpr (Used > 2) product *= uniform_from(words[2]);
    if constexpr (Used > 3) product *= uniform_from(words[3]);
    products[i] = product;
  }
}

FANBEAM_HOT(void, add_exponentials,
            (const Words& key, std::uint32_t frame, std::uint64_t first, int count,
             std::size_t cells, double* sums),
            (key, frame, first, count, cells, sums)) {
  for (std::size_t i = 0; i < cells; ++i) sums[i] = 1.0;
  std::uint32_t draw = 0;
  for (; count >= 4; count -= 4) multiply<4>(key, frame, draw++, first, cells, sums);
  if (count == 3) multiply<3>(key, frame, draw, first, cells, sums);
  if (count == 2) multiply<2>(key, frame, draw, first, cells, sums);
  if (count == 1) multiply<1>(key, frame, draw, first, cells, sums);
  for (std::size_t i = 0; i < cells; ++i) sums[i] = -series_log(sums[i]);
}

}  // namespace

void sums_of_exponentials(const RandomKey& key, std::uint64_t first, int count,
                          std::span<double> sums) {
  add_exponentials(philox_key(key), static_cast<std::uint32_t>(key.frame), first, count,
                   sums.size(), sums.data());
}

}  // namespace fanbeam::core
