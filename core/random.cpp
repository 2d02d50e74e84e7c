#include "core/random.h"

#include <cmath>

#include "core/constants.h"
#include "core/dispatch.h"
#include "core/philox_private.h"
#include "core/series.h"

namespace fanbeam::core {

std::array<std::uint32_t, 4> random_words(const RandomKey& key, std::uint64_t cell,
                                          std::uint32_t draw) {
  const auto words = philox_words(key, cell, draw);
  return {words[0], words[1], words[2], words[3]};
}

std::array<double, 2> normal_pair(const RandomKey& key, std::uint64_t cell, std::uint32_t draw) {
  const auto words = random_words(key, cell, draw);
  const double radius = std::sqrt(-2.0 * std::log(uniform_from(words[0])));
  const double angle = 2.0 * kPi * uniform_from(words[1]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

namespace {

// Multiplies by the first `Used` uniform numbers of one draw.
template <int Used>
inline void multiply(const RandomKey& key, std::uint32_t draw, std::uint64_t first,
                     std::size_t cells, double* products) {
  for (std::size_t i = 0; i < cells; ++i) {
    const auto words = philox_words(key, first + i, draw);
    double product = products[i] * uniform_from(words[0]);
    if constexpr (Used > 1) product *= uniform_from(words[1]);
    if constexpr (Used > 2) product *= uniform_from(words[2]);
    if constexpr (Used > 3) product *= uniform_from(words[3]);
    products[i] = product;
  }
}

FANBEAM_HOT(void, add_exponentials,
            (const RandomKey& key, std::uint64_t first, int count, std::size_t cells, double* sums),
            (key, first, count, cells, sums)) {
  for (std::size_t i = 0; i < cells; ++i) sums[i] = 1.0;
  std::uint32_t draw = 0;
  for (; count >= 4; count -= 4) multiply<4>(key, draw++, first, cells, sums);
  if (count == 3) multiply<3>(key, draw, first, cells, sums);
  if (count == 2) multiply<2>(key, draw, first, cells, sums);
  if (count == 1) multiply<1>(key, draw, first, cells, sums);
  for (std::size_t i = 0; i < cells; ++i) sums[i] = -series_log(sums[i]);
}

}  // namespace

void sums_of_exponentials(const RandomKey& key, std::uint64_t first, int count,
                          std::span<double> sums) {
  add_exponentials(key, first, count, sums.size(), sums.data());
}

}  // namespace fanbeam::core
