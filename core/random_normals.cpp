#include "core/random_normals.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/dispatch.h"
#include "core/philox_private.h"

namespace fanbeam::core {
namespace {

constexpr int kBlocks = 16;            // side by side
constexpr int kNumbers = 4 * kBlocks;  // of one group

struct Words {
  std::uint32_t of[4][kBlocks];
};

// ln(x) for a normal number above 0.
inline float natural_logarithm(float x) {
  // x = 2^e (1 + f), 1 + f from sqrt(1/2) to sqrt(2).
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;
  const float f = std::bit_cast<float>(bits - exponent * (1 << 23)) - 1.0F;
  const auto e = static_cast<float>(exponent);
  const float square = f * f;
  float series = 7.0376836292e-2F;
  series = series * f - 1.1514610310e-1F;
  series = series * f + 1.1676998740e-1F;
  series = series * f - 1.2420140846e-1F;
  series = series * f + 1.4249322787e-1F;
  series = series * f - 1.6668057665e-1F;
  series = series * f + 2.0000714765e-1F;
  series = series * f - 2.4999993993e-1F;
  series = series * f + 3.3333331174e-1F;
  // ln 2 in two parts, of which the large one has few digits.
  const float low = series * f * square - 2.12194440e-4F * e - 0.5F * square;
  return f + low + 0.693359375F * e;
}

inline float radius(std::uint32_t word) {
  const float u = (static_cast<float>(static_cast<std::int32_t>(word >> 1U)) + 0.5F) * 0x1p-31F;
  return std::sqrt(-2.0F * natural_logarithm(u));
}

// Of `word` / 2^32 turns, by the nearest quarter turn and what is left of it.
struct Direction {
  float cosine, sine;
};
inline Direction direction(std::uint32_t word) {
  const std::uint32_t quarter = (word + 0x20000000U) >> 30U;
  const auto left = static_cast<std::int32_t>(word - (quarter << 30U));
  const float x = static_cast<float>(left) * 1.4629180792671596e-9F;  // 2 pi / 2^32
  const float square = x * x;
  const float sine =
      x +
      x * square * ((-1.9515295891e-4F * square + 8.3321608736e-3F) * square - 1.6666654611e-1F);
  const float cosine = 1.0F - 0.5F * square +
                       square * square *
                           ((2.443315711809948e-5F * square - 1.388731625493765e-3F) * square +
                            4.166664568298827e-2F);
  const bool odd = (quarter & 1U) != 0;
  const std::uint32_t cosine_sign = ((quarter + 1U) & 2U) << 30U;
  const std::uint32_t sine_sign = (quarter & 2U) << 30U;
  return {std::bit_cast<float>(std::bit_cast<std::uint32_t>(odd ? sine : cosine) ^ cosine_sign),
          std::bit_cast<float>(std::bit_cast<std::uint32_t>(odd ? cosine : sine) ^ sine_sign)};
}

FANBEAM_HOT(void, fill_groups,
            (const RandomKey& key, std::uint32_t draw, std::uint64_t group, std::size_t count,
             float* numbers),
            (key, draw, group, count, numbers)) {
  for (std::size_t g = 0; g < count; ++g, ++group, numbers += kNumbers) {
    Words words;
    // A loop that is unrolled does not become vector code.
#pragma GCC unroll 1
    for (int i = 0; i < kBlocks; ++i) {
      const auto block = philox_words(key, group * kBlocks + static_cast<std::uint64_t>(i), draw);
      words.of[0][i] = block[0];
      words.of[1][i] = block[1];
      words.of[2][i] = block[2];
      words.of[3][i] = block[3];
    }
    for (int pair = 0; pair < 2; ++pair)
      for (int i = 0; i < kBlocks; ++i) {
        const float r = radius(words.of[2 * pair][i]);
        const Direction towards = direction(words.of[2 * pair + 1][i]);
        numbers[2 * pair * kBlocks + i] = r * towards.cosine;
        numbers[(2 * pair + 1) * kBlocks + i] = r * towards.sine;
      }
  }
}

}  // namespace

void normal_numbers(const RandomKey& key, std::uint32_t draw, std::uint64_t first,
                    std::size_t count, float* numbers) {
  // Begun and ended groups go by way of `group`.
  float group[kNumbers];
  const auto part = [&](std::uint64_t begin, std::size_t some) {
    const auto skipped = static_cast<std::size_t>(begin % kNumbers);
    fill_groups(key, draw, begin / kNumbers, 1, group);
    std::copy_n(group + skipped, some, numbers);
    numbers += some;
  };
  const auto before = static_cast<std::size_t>((kNumbers - first % kNumbers) % kNumbers);
  const std::size_t head = std::min(count, before);
  if (head > 0) part(first, head);
  const std::size_t whole = (count - head) / kNumbers;
  fill_groups(key, draw, (first + head) / kNumbers, whole, numbers);
  numbers += whole * kNumbers;
  const std::size_t tail = count - head - whole * kNumbers;
  if (tail > 0) part(first + head + whole * kNumbers, tail);
}

}  // namespace fanbeam::core
