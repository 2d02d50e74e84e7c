// A request to stop ends parallel loops at their next body, by an exception that unwinds.
#include "core/stop.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>

#include "core/parallel.h"

using namespace fanbeam;

TEST_CASE("A request to stop is seen by every loop until it is forgotten", "[stop]") {
  REQUIRE(core::stop_signal() == 0);
  CHECK_NOTHROW(core::throw_if_stopped());
  std::atomic<int> bodies{0};
  {
    const core::ThreadLimit one(1);
    CHECK_THROWS_AS(core::parallel_for(1000,
                                       [&](std::size_t) {
                                         if (++bodies == 10) core::request_stop(SIGTERM);
                                       }),
                    core::Stopped);
  }
  CHECK(bodies == 10);
  core::request_stop(SIGINT);
  CHECK(core::stop_signal() == SIGTERM);  // the first one counts
  CHECK_THROWS_AS(core::parallel_for(3, [&](std::size_t) { ++bodies; }), core::Stopped);
  CHECK(bodies == 10);
  core::forget_stop();
  core::parallel_for(3, [&](std::size_t) { ++bodies; });
  CHECK(bodies == 13);
}
