// Hard case M06: random numbers that do not depend on scheduling.
#include "core/random.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "core/machine.h"

using namespace fanbeam::core;
using Block = std::array<std::uint32_t, 4>;

namespace {

// Of a counter and a key as they are: of stream 0 the key is the seed.
Block philox_block(const Block& counter, const std::array<std::uint32_t, 2>& key) {
  return random_words({key[0] + (std::uint64_t{key[1]} << 32U), 0, counter[3]},
                      counter[0] + (std::uint64_t{counter[1]} << 32U), counter[2]);
}

}  // namespace

TEST_CASE("M06 Philox 4x32-10 gives the published known answers", "[M06]") {
  // kat_vectors of Random123 (Salmon et al., SC'11): zeros, ones, digits of pi.
  constexpr std::uint32_t kOnes = 0xFFFFFFFFU;
  CHECK(philox_block({0, 0, 0, 0}, {0, 0}) ==
        Block{0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8});
  CHECK(philox_block({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}) ==
        Block{0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD});
  CHECK(philox_block({0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344}, {0xA4093822, 0x299F31D0}) ==
        Block{0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1});
}

TEST_CASE("M06 a draw depends on every part of its name and on nothing else", "[M06]") {
  const RandomKey key{7, kStreamTerrain, 3};
  std::set<Block> blocks;
  blocks.insert(random_words(key, 11, 0));
  blocks.insert(random_words(key, 11, 1));
  blocks.insert(random_words(key, 12, 0));
  blocks.insert(random_words(key, 11 + (std::uint64_t{1} << 32U), 0));
  blocks.insert(random_words({8, kStreamTerrain, 3}, 11, 0));
  blocks.insert(random_words({7 + (std::uint64_t{1} << 32U), kStreamTerrain, 3}, 11, 0));
  blocks.insert(random_words({7, kStreamTurbulence, 3}, 11, 0));
  blocks.insert(random_words({7, kStreamTerrain, 4}, 11, 0));
  CHECK(blocks.size() == 8);
  // Drawn again after all the others: the same.
  CHECK(blocks.count(random_words(key, 11, 0)) == 1);
  CHECK(random_words(key, 11, 0) == random_words(key, 11, 0));
}

TEST_CASE("M06 no frame repeats after 2^32, and the words of the first 2^32 are those of ever",
          "[M06]") {
  constexpr std::uint64_t kTurn = std::uint64_t{1} << 32U;
  // Seed 7 and stream 4 (times 2^32 over the golden ratio) make Philox's key.
  const Block first = philox_block({11, 0, 2, 3}, {7, 4 * 0x9E3779B9U});
  CHECK(random_words({7, kStreamSpeckle, 3}, 11, 2) == first);
  CHECK(random_words({7, kStreamSpeckle, kTurn - 1}, 11, 2) ==
        philox_block({11, 0, 2, 0xFFFFFFFFU}, {7, 4 * 0x9E3779B9U}));
  std::set<Block> blocks;
  for (std::uint64_t turn = 0; turn < 1000; ++turn)
    for (std::uint32_t stream = 0; stream < 32; ++stream)
      blocks.insert(random_words({7, stream, turn * kTurn + 3}, 11, 2));
  CHECK(blocks.size() == 32000);
  CHECK(blocks.count(first) == 1);
}

TEST_CASE("Uniform numbers lie in the open interval, also for the extreme words", "[random]") {
  CHECK(uniform_from(0) == 0x1p-33);
  CHECK(uniform_from(0xFFFFFFFFU) == 1.0 - 0x1p-33);
  CHECK(-std::log(uniform_from(0)) == Approx(22.8739).epsilon(0.0).margin(1e-4));
}

TEST_CASE("Normal numbers have mean 0, variance 1, no correlation and normal tails", "[random]") {
  constexpr int kPairs = 500000;  // a million numbers
  const RandomKey key{20, kStreamTurbulence, 0};
  double sum = 0.0, squares = 0.0, products = 0.0;
  int beyond_two = 0;
  for (int cell = 0; cell < kPairs; ++cell) {
    const auto [a, b] = normal_pair(key, static_cast<std::uint64_t>(cell), 0);
    sum += a + b;
    squares += a * a + b * b;
    products += a * b;
    beyond_two += static_cast<int>(std::abs(a) > 2.0) + static_cast<int>(std::abs(b) > 2.0);
  }
  // Four standard deviations of each estimate: 1/sqrt(1e6), sqrt(2/1e6), 1/sqrt(5e5), sqrt(0.0455 *
  // 0.9545 / 1e6).
  CHECK(sum / (2.0 * kPairs) == Approx(0.0).epsilon(0.0).margin(0.004));
  CHECK(squares / (2.0 * kPairs) == Approx(1.0).epsilon(0.0).margin(0.0057));
  CHECK(products / kPairs == Approx(0.0).epsilon(0.0).margin(0.0057));
  CHECK(beyond_two / (2.0 * kPairs) == Approx(0.0455003).epsilon(0.0).margin(0.00084));
}

TEST_CASE("Sums of exponentials of cells side by side are those of their own draws, at every level",
          "[random]") {
  const RandomKey key{2026, kStreamSpeckle, (std::uint64_t{3} << 32U) + 5};
  const std::uint64_t first = (std::uint64_t{1} << 32U) - 7;  // cells on both sides of 2^32
  std::vector<double> before;
  for (const InstructionLevel level :
       {InstructionLevel::v2, InstructionLevel::v3, InstructionLevel::v4}) {
    if (level > machine_level()) continue;
    limit_instructions(level, "level");
    std::vector<double> all;
    for (const int count : {1, 2, 3, 4, 5, 11, kMostExponentials}) {
      std::vector<double> sums(37);
      sums_of_exponentials(key, first, count, sums);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        double expected = 0.0;
        for (int k = 0; k < count; ++k)
          expected -= std::log(uniform_from(random_words(
              key, first + i, static_cast<std::uint32_t>(k / 4))[static_cast<std::size_t>(k % 4)]));
        // 28 roundings of a product, beside sums that are seldom below a tenth.
        CHECK(sums[i] == Approx(expected).epsilon(1e-13));
      }
      all.insert(all.end(), sums.begin(), sums.end());
    }
    if (before.empty()) before = all;
    CHECK(all == before);
  }
  limit_instructions(std::nullopt, "");
}
