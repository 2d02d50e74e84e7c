// One block of Philox 4x32-10 inline, for loops over cells that shall become vector code: random.h
// says what its words are for.
#pragma once

#include <Random123/philox.h>

#include <cstdint>

#include "core/random.h"

namespace fanbeam::core {

// As random_words. Cell, draw and the lower half of the frame make the counter.
inline r123::Philox4x32::ctr_type philox_words(const RandomKey& key, std::uint64_t cell,
                                               std::uint32_t draw) {
  const auto [key0, key1] = philox_key(key);
  return r123::Philox4x32{}(
      {{static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell >> 32U), draw,
        static_cast<std::uint32_t>(key.frame)}},
      {{key0, key1}});
}

}  // namespace fanbeam::core
