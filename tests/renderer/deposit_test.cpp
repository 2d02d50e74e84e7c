#include "renderer/casting/deposit.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "renderer/casting/interval_deposit.h"

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

TEST_CASE("R07 each patch keeps its energy, share by share", "[deposit]") {
  const core::RandomKey key{7, 101, 0};
  constexpr int kBins = 40;
  int wrong = 0;
  for (std::uint64_t i = 0; i < 1'000'000; ++i) {
    const auto words = core::random_words(key, i, 0);
    const double width = i % 10 == 0 ? 0.0 : core::uniform_from(words[1]) * 10.0;
    // Anywhere; or exactly from the first edge or to the last one.
    const double from = i % 3 == 0   ? core::uniform_from(words[0]) * 60.0 - 10.0
                        : i % 3 == 1 ? 0.0
                                     : kBins - width;
    double bins[kBins] = {};
    renderer::deposit(from, from + width, 1.0, bins, kBins);
    double sum = 0.0;
    int reached = 0;
    for (const double share : bins) {
      wrong += share < 0.0 ? 1 : 0;
      reached += share > 0.0 ? 1 : 0;
      sum += share;
    }
    const bool starts_inside = from >= 0.0 && from < kBins;
    if (width == 0.0) {
      wrong += reached == (starts_inside ? 1 : 0) ? 0 : 1;
    } else if (from >= 0.0 && from + width <= kBins) {
      wrong += std::abs(sum - 1.0) <= 1e-12 ? 0 : 1;
    } else {
      const double covered =
          std::max(0.0, std::min(from + width, double{kBins}) - std::max(from, 0.0)) / width;
      wrong += std::abs(sum - covered) <= 1e-12 ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("R07 the intervals of a chain of rays hold all that its rays stand for", "[deposit]") {
  sensors::Sensor sensor;
  sensor.range = {0.0, 6.67, 600};
  sensor.display.cscope_top_rad = 2.0;
  sensor.display.cscope_span_rad = 4.0;
  sensor.display.cscope_rows = 300;
  constexpr double kLimit_m = 60.0;  // nine cells
  constexpr int kRays = 1000;
  double worst = 0.0;
  for (std::uint32_t chain_index = 0; chain_index < 1000; ++chain_index) {
    renderer::RayChain chain;
    chain.append(kRays);
    double elevation_rad = -1.0, range_m = 100.0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const auto words = core::random_words({7, 102, 0}, i, chain_index);
      elevation_rad += 2e-3 * core::uniform_from(words[0]);
      // Steps of up to ten cells, some of them to another surface.
      range_m = std::clamp(range_m + 133.0 * (core::uniform_from(words[1]) - 0.45), 100.0, 3800.0);
      chain.elevation_rad[i] = elevation_rad;
      chain.range_m[i] = static_cast<float>(range_m);
      chain.range_slope[i] = static_cast<float>(20.0 * (core::uniform_from(words[2]) - 0.5));
      chain.density_W_per_rad2[i] = static_cast<float>(core::uniform_from(words[3]));
      chain.surface[i] = words[3] % 4;
      chain.next[i] = i + 1 < kRays ? static_cast<std::int32_t>(i) + 1 : renderer::RayChain::kEnd;
    }
    const double low_rad = -1.001, high_rad = elevation_rad + 1e-3;
    double expected = 0.0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const double below_rad =
          i == 0 ? low_rad : (chain.elevation_rad[i - 1] + chain.elevation_rad[i]) / 2;
      const double above_rad =
          i + 1 == kRays ? high_rad : (chain.elevation_rad[i] + chain.elevation_rad[i + 1]) / 2;
      expected += static_cast<double>(chain.density_W_per_rad2[i]) * (above_rad - below_rad);
    }
    renderer::DepositBins bins;
    renderer::IntervalDeposit(sensor, true, kLimit_m, low_rad, high_rad, bins).add(chain, 0);
    std::vector<double> cells(600);
    bins.range.copy_to(cells.data());
    REQUIRE(*std::min_element(cells.begin(), cells.end()) >= 0.0);
    const double sum = std::accumulate(cells.begin(), cells.end(), 0.0);
    worst = std::max(worst, std::abs(sum / expected - 1.0));
  }
  INFO("worst " << worst);
  CHECK(worst <= 1e-12);
}

TEST_CASE("R07 a density that rises from end to end keeps its energy and its slope", "[deposit]") {
  double bins[4] = {};
  // Of the way x there lies the share x [1 + tilt (x - 1)] before it: 7/72 at 1/6, 3/8 at 1/2.
  renderer::deposit(0.5, 3.5, 36.0, bins, 4, 0.5);
  CHECK(bins[0] == Approx(3.5));
  CHECK(bins[1] == Approx(10.0));
  CHECK(bins[2] == Approx(14.0));
  CHECK(bins[3] == Approx(8.5));
  // What lies outside is not deposited.
  double inside[2] = {};
  renderer::deposit(-1.5, 1.5, 36.0, inside, 2, 0.5);
  CHECK(inside[0] == Approx(14.0));
  CHECK(inside[1] == Approx(8.5));
}
