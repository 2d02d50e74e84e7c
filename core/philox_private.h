// One block of Philox 4x32-10 inline, for loops over cells that shall become vector code: random.h
// says what its words are for.
#pragma once

#include <Random123/philox.h>

#include <cstdint>

#include "core/random.h"

namespace fanbeam::core {

// As random_words; `key` is that of philox_key, `frame` the lower half.
inline r123::Philox4x32::ctr_type philox_words(const std::array<std::uint32_t, 2>& key,
                                               std::uint32_t frame, std::uint64_t cell,
                                               std::uint32_t draw) {
  return r123::Philox4x32{}(
      {{static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell >> 32U), draw, frame}},
      {{key[0], key[1]}});
}

}  // namespace fanbeam::core
