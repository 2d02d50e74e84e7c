#include "renderer/casting/deposit.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"

using namespace fanbeam;

TEST_CASE("R07 deposited and lost energy add up to the input; no share is negative", "[deposit]") {
  const core::RandomKey key{7, 100, 0};
  constexpr int kBins = 40;
  std::vector<double> bins(kBins + 2 * 16, 0.0);
  double total = 0.0;
  double inside = 0.0;
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    const auto words = core::random_words(key, i, 0);
    const double from =
        core::uniform_from(words[0]) * 60.0 - 10.0;  // some patches lie outside entirely
    const double width = i % 10 == 0 ? 0.0 : core::uniform_from(words[1]) * 10.0;
    const double amount = core::uniform_from(words[2]);
    renderer::deposit(from, from + width, amount, &bins[16], kBins);
    total += amount;
    const double covered =
        width > 0.0
            ? std::max(0.0, std::min(from + width, double{kBins}) - std::max(from, 0.0)) / width
            : (from >= 0.0 && from < kBins ? 1.0 : 0.0);
    inside += amount * covered;
  }
  double deposited = 0.0;
  for (int bin = 0; bin < kBins; ++bin) {
    CHECK(bins[static_cast<std::size_t>(16 + bin)] >= 0.0);
    deposited += bins[static_cast<std::size_t>(16 + bin)];
  }
  CHECK(deposited == Approx(inside).epsilon(1e-12));
  CHECK(deposited < total);
  for (int guard = 0; guard < 16; ++guard) {
    CHECK(bins[static_cast<std::size_t>(guard)] == 0.0);
    CHECK(bins[static_cast<std::size_t>(16 + kBins + guard)] == 0.0);
  }
}

TEST_CASE("R07 a patch without width goes to exactly one bin, borders are half open", "[deposit]") {
  double bins[3] = {};
  renderer::deposit(1.0, 1.0, 5.0, bins, 3);
  CHECK(bins[0] == 0.0);
  CHECK(bins[1] == 5.0);
  renderer::deposit(3.0, 3.0, 5.0, bins, 3);
  renderer::deposit(0.0, 0.0, 2.0, bins, 3);
  CHECK(bins[0] == 2.0);
  CHECK(bins[2] == 0.0);
}
