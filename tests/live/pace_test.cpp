// The controller of sampling, at the clock of the test.
#include "live/pace.h"

#include <catch2/catch.hpp>

using fanbeam::live::Pace;

namespace {

const std::vector<double> kLadder{1, 2, 4, 8};
constexpr double kPeriod_s = 0.1;

// Frames that take `fixed_s` and `each_s` for every sample, for `span_s`. How often the sampling
// changed.
int fly(Pace& pace, double& now_s, double span_s, double fixed_s, double each_s) {
  int changes = 0;
  for (const double end_s = now_s + span_s; now_s < end_s; now_s += kPeriod_s) {
    const double before = pace.samples();
    if (pace.after(now_s, fixed_s + each_s * before) != before) ++changes;
  }
  return changes;
}

}  // namespace

TEST_CASE("Sampling grows to what the period has room for, and no further", "[pace]") {
  Pace pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  CHECK(pace.samples() == 1);
  fly(pace, now_s, 30.0, 0.01, 0.01);  // 4 take 50 ms, 8 would take 90 of the 80 there are
  CHECK(pace.samples() == 4);
  Pace rich(kLadder, kPeriod_s);
  now_s = 0.0;
  fly(rich, now_s, 30.0, 0.0, 0.001);
  CHECK(rich.samples() == 8);
}

TEST_CASE(
    "The second of a hundred frames over its share, or a very slow one, and the next is coarser",
    "[pace]") {
  Pace pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  fly(pace, now_s, 30.0, 0.01, 0.01);
  // One in a hundred is what the 99th percentile leaves.
  CHECK(pace.after(now_s, 0.081) == 4);
  fly(pace, now_s, 9.0, 0.01, 0.01);
  CHECK(pace.samples() == 4);
  CHECK(pace.after(now_s, 0.081) == 2);
  CHECK(pace.after(now_s + 0.1, 0.21) == 1);
  CHECK(pace.after(now_s + 0.2, 5.0) == 1);
}

TEST_CASE("What does not depend on the samples does not keep the sampling coarse", "[pace]") {
  // As over a city: 33 ms of a thread and 40 a sample, where 50 ms of two are there.
  Pace pace({0.3, 0.5, 0.7, 1, 1.2, 1.4, 1.7, 2}, 0.0625);
  double now_s = 0.0;
  for (const double end_s = 60.0; now_s < end_s; now_s += 0.0625)
    pace.after(now_s, (0.033 + 0.040 * pace.samples()) / 1.9);
  CHECK(pace.samples() >= 1.2);
}

TEST_CASE("Sampling grows at a frame in ten seconds too", "[pace]") {
  Pace pace(kLadder, 10.0);
  for (int frame = 0; frame < 30; ++frame) pace.after(10.0 * frame, 0.001);
  CHECK(pace.samples() == 8);
}

TEST_CASE("What is too slow outside the volume is coarser there alone", "[pace]") {
  fanbeam::live::PaceByVolume pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  const auto next = [&](double frame_s, bool outside) {
    return pace.after(now_s += kPeriod_s, frame_s, outside);
  };
  for (int i = 0; i < 300; ++i) next(0.01 + 0.01 * pace.samples(), false);
  REQUIRE(pace.samples() == 4);
  CHECK(next(0.25, true) == 2);
  CHECK(next(0.25, true) == 1);
  for (int i = 0; i < 100; ++i) CHECK(next(0.09, true) == 1);
  CHECK(next(0.05, false) == 4);
  for (int i = 0; i < 100; ++i) CHECK(next(0.05, false) == 4);
}

TEST_CASE("A step that was too slow is left alone for ten seconds", "[pace]") {
  Pace pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  fly(pace, now_s, 30.0, 0.01, 0.01);
  pace.after(now_s, 0.25);
  CHECK(pace.samples() == 2);
  CHECK(fly(pace, now_s, 9.5, 0.01, 0.01) == 0);
  fly(pace, now_s, 3.0, 0.01, 0.01);
  CHECK(pace.samples() == 4);
}
