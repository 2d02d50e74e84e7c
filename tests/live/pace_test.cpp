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

TEST_CASE("One frame over its share and the next is coarser; the coarsest stays", "[pace]") {
  Pace pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  fly(pace, now_s, 30.0, 0.01, 0.01);
  CHECK(pace.after(now_s, 0.081) == 2);
  CHECK(pace.after(now_s + 0.1, 0.2) == 1);
  CHECK(pace.after(now_s + 0.2, 5.0) == 1);
}

TEST_CASE("A step that was too slow is left alone for ten seconds", "[pace]") {
  Pace pace(kLadder, kPeriod_s);
  double now_s = 0.0;
  fly(pace, now_s, 30.0, 0.01, 0.01);
  pace.after(now_s, 0.2);
  CHECK(pace.samples() == 2);
  CHECK(fly(pace, now_s, 9.5, 0.01, 0.01) == 0);
  fly(pace, now_s, 3.0, 0.01, 0.01);
  CHECK(pace.samples() == 4);
}
