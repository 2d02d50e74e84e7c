#include "core/parallel.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/random.h"

using namespace fanbeam::core;

namespace {

// Sums whose rounding depends on their order, one per index.
std::vector<double> sums_with(int threads) {
  const ThreadLimit limit(threads);
  std::vector<double> sums(1000);
  parallel_for(sums.size(), [&](std::size_t i) {
    for (std::uint32_t draw = 0; draw < 200; ++draw)
      sums[i] += std::exp(10.0 * normal_pair({1, kStreamTerrain, 0}, i, draw)[0]);
  });
  return sums;
}

}  // namespace

TEST_CASE("Every index is handled exactly once", "[parallel]") {
  std::vector<std::atomic<int>> visits(10007);
  parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& count : visits) REQUIRE(count == 1);
  parallel_for(0, [](std::size_t) { FAIL("called for an empty range"); });
}

TEST_CASE("Results are the same bytes for 1, 2, 3 and 8 threads and a second run", "[parallel]") {
  const std::vector<double> expected = sums_with(1);
  for (const int threads : {1, 2, 3, 8}) {
    const std::vector<double> sums = sums_with(threads);
    CHECK(std::memcmp(sums.data(), expected.data(), sums.size() * sizeof(double)) == 0);
  }
}

TEST_CASE("An exception of the body reaches the caller", "[parallel]") {
  CHECK_THROWS_AS(parallel_for(100,
                               [](std::size_t i) {
                                 if (i == 63) throw std::runtime_error("index 63");
                               }),
                  std::runtime_error);
}

TEST_CASE("A limit of one keeps the loop on the caller's thread, and ends with its life",
          "[parallel]") {
  {
    const ThreadLimit limit(1);
    CHECK(limit.threads() == 1);
    std::set<std::thread::id> used;
    parallel_for(1000, [&](std::size_t) { used.insert(std::this_thread::get_id()); });
    CHECK(used == std::set<std::thread::id>{std::this_thread::get_id()});
  }
  const ThreadLimit all(0);
  CHECK(all.threads() >= 1);
}

TEST_CASE("A limit holds for the loops of its thread alone", "[parallel]") {
  const ThreadLimit one(1);
  std::atomic<int> met{0};
  std::thread([&met] {
    std::atomic<int> here{0};
    parallel_for(2, [&](std::size_t) {
      ++here;
      // Seen by both only if another thread runs the other one meanwhile.
      const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(10);
      while (here < 2 && std::chrono::steady_clock::now() < late) std::this_thread::yield();
      met += here == 2 ? 1 : 0;
    });
  }).join();
  CHECK(met == 2);
}
