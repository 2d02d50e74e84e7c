#include "core/random.h"

#include <Random123/philox.h>

#include <cmath>

#include "core/constants.h"

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

}  // namespace fanbeam::core
