// A request to stop ends the loops of the work that it is for, by an exception that unwinds.
#include "core/stop.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>
#include <thread>

#include "core/parallel.h"

using namespace fanbeam;

TEST_CASE("A request to stop is seen by every loop under its token", "[stop]") {
  core::StopSource source;
  const core::StopToken token = source.token();
  std::atomic<int> bodies{0};
  const core::StopScope scope(token);
  CHECK_NOTHROW(core::throw_if_stopped());
  {
    const core::ThreadLimit one(1);
    CHECK_THROWS_AS(core::parallel_for(1000,
                                       [&](std::size_t) {
                                         if (++bodies == 10) source.request(SIGTERM);
                                       }),
                    core::Stopped);
  }
  CHECK(bodies == 10);
  source.request(SIGINT);
  CHECK(token.reason() == SIGTERM);  // the first one counts
  CHECK_THROWS_AS(core::parallel_for(3, [&](std::size_t) { ++bodies; }), core::Stopped);
  CHECK(bodies == 10);
}

TEST_CASE("A loop inside a loop is stopped on whichever thread it runs", "[stop]") {
  core::StopSource source;
  const core::StopToken token = source.token();
  const core::StopScope scope(token);
  std::atomic<int> inner{0};
  CHECK_THROWS_AS(core::parallel_for(64,
                                     [&](std::size_t) {
                                       source.request();
                                       core::parallel_for(1000, [&](std::size_t) { ++inner; });
                                     }),
                  core::Stopped);
  CHECK(inner == 0);
}

TEST_CASE("Other work goes on when one is stopped", "[stop]") {
  core::StopSource source;
  source.request();
  const core::StopToken token = source.token();
  const core::StopScope scope(token);
  CHECK_THROWS_AS(core::throw_if_stopped(), core::Stopped);
  {
    const core::StopToken nobody;
    const core::StopScope inside(nobody);  // of a request of its own inside this work
    CHECK_NOTHROW(core::throw_if_stopped());
  }
  std::atomic<int> bodies{0};
  std::thread([&] { core::parallel_for(100, [&](std::size_t) { ++bodies; }); }).join();
  CHECK(bodies == 100);
  CHECK_THROWS_AS(core::throw_if_stopped(), core::Stopped);
}
