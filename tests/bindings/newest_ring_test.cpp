// Readers of the ring see whole contents, never older ones than before, whatever the writer does.
#include "bindings/c/newest_ring.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdint>
#include <deque>
#include <memory>
#include <thread>
#include <vector>

namespace {

template <std::size_t kCount>
using WordsOf = std::array<std::uint64_t, kCount>;  // all alike: a torn one shows
using Words = WordsOf<4096>;
template <class Content>
using RingOf = fanbeam::bindings::NewestRing<Content>;
using Ring = RingOf<Words>;

template <class Content>
bool write(RingOf<Content>& ring, std::uint64_t number) {
  Content* const words = ring.claim();
  if (words == nullptr) return false;
  words->fill(number);
  ring.publish(number);
  return true;
}

bool has_other_than(Ring& ring, std::uint64_t have) {
  return static_cast<bool>(ring.other_than(have));
}

template <class Content>
bool is_whole(const Content& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](std::uint64_t word) { return word == words[0]; });
}

}  // namespace

TEST_CASE("The ring has nothing before the first and nothing new after the newest", "[bindings]") {
  const auto ring = std::make_unique<Ring>();
  CHECK_FALSE(has_other_than(*ring, 0));
  CHECK_FALSE(has_other_than(*ring, 5));
  REQUIRE(write(*ring, 1));
  CHECK((*ring->other_than(0))[0] == 1);
  CHECK_FALSE(has_other_than(*ring, 1));
  for (std::uint64_t number = 2; number <= 3 * Ring::kSlots; ++number) {
    REQUIRE(write(*ring, number));
    CHECK((*ring->other_than(number - 1))[7] == number);
  }
}

TEST_CASE("What a reader holds stays, and the writer goes round it", "[bindings]") {
  const auto ring = std::make_unique<Ring>();
  REQUIRE(write(*ring, 1));
  {
    const Ring::Hold held = ring->other_than(0);
    for (std::uint64_t number = 2; number <= 100; ++number) REQUIRE(write(*ring, number));
    CHECK((*held)[0] == 1);
    CHECK(is_whole(*held));
    CHECK((*ring->other_than(1))[0] == 100);
  }
  // With a reader in every slot the writer has none, until one leaves.
  std::deque<Ring::Hold> holds;
  for (std::uint64_t number = 101; number < 101 + Ring::kSlots; ++number) {
    REQUIRE(write(*ring, number));
    holds.push_back(ring->other_than(0));
  }
  CHECK_FALSE(write(*ring, 200));
  holds.pop_front();
  CHECK(write(*ring, 200));
}

// Long contents are caught half written. With short ones the writer fills the slot that a reader is
// about to count itself into, and has not named it yet.
TEMPLATE_TEST_CASE("Threads that read the ring while another writes see whole contents that rise",
                   "[bindings][threads]", Words, WordsOf<1>) {
  const auto ring = std::make_unique<RingOf<TestType>>();
  const std::uint64_t numbers = sizeof(TestType) > 1000 ? 2000 : 200000;
  std::atomic<bool> done{false};
  std::atomic<int> torn{0}, backwards{0}, seen{0};
  const auto read = [&] {
    std::uint64_t have = 0;
    while (!done) {
      const auto held = ring->other_than(have);
      if (!held) continue;
      if (!is_whole(*held)) ++torn;
      if ((*held)[0] < have) ++backwards;
      have = (*held)[0];
      ++seen;
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) readers.emplace_back(read);
  std::uint64_t number = 0;
  while (number < numbers || seen < 30) {
    if (write(*ring, number + 1)) ++number;
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  CHECK(torn == 0);
  CHECK(backwards == 0);
}
