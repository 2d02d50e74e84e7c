// The controller of sampling, at the clock of the test.
#include "live/pace.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using fanbeam::live::Pace;

namespace {

const std::vector<double> kLadder{1, 2, 4, 8};
constexpr double kDeadline_s = 0.1;

// Frames that take `fixed_s` and `each_s` for every sample, for `span_s`. How often the sampling
// changed.
int fly(Pace& pace, double& now_s, double span_s, double fixed_s, double each_s) {
  int changes = 0;
  for (const double end_s = now_s + span_s; now_s < end_s; now_s += kDeadline_s) {
    const double before = pace.samples();
    if (pace.after(now_s, fixed_s + each_s * before) != before) ++changes;
  }
  return changes;
}

}  // namespace

TEST_CASE("Sampling grows to what the period has room for, and no further", "[pace]") {
  Pace pace(kLadder, kDeadline_s);
  double now_s = 0.0;
  CHECK(pace.samples() == 1);
  fly(pace, now_s, 30.0, 0.01, 0.01);  // 4 take 50 ms, 8 would take 90 of the 80 there are
  CHECK(pace.samples() == 4);
  Pace rich(kLadder, kDeadline_s);
  now_s = 0.0;
  fly(rich, now_s, 30.0, 0.0, 0.001);
  CHECK(rich.samples() == 8);
}

// The second of a hundred made it coarser, which a sampling that holds the hundredth has every minute.
TEST_CASE("More late frames than a hundredth make the next one a step coarser, fewer do not",
          "[pace]") {
  const auto coarser_after = [](int apart) {
    Pace pace(kLadder, kDeadline_s);
    double now_s = 0.0;
    fly(pace, now_s, 30.0, 0.01, 0.01);
    int late = 0;
    while (pace.samples() == 4 && late < 160) {
      for (int frame = 1; frame < apart; ++frame) pace.after(now_s += kDeadline_s, 0.05);
      pace.after(now_s += kDeadline_s, 0.081);
      ++late;
    }
    return late;
  };
  CHECK(coarser_after(120) == 160);
  CHECK(coarser_after(60) <= 12);
  CHECK(coarser_after(20) <= 7);
}

TEST_CASE("Three late frames of five, and the next is as coarse as they need", "[pace]") {
  Pace pace(kLadder, kDeadline_s);
  double now_s = 0.0;
  fly(pace, now_s, 30.0, 0.01, 0.01);
  for (const double frame_s : {0.081, 0.05, 5.0, 0.05}) CHECK(pace.after(now_s, frame_s) == 4);
  fly(pace, now_s, 1.0, 0.01, 0.01);
  for (const double frame_s : {0.1, 0.05, 0.1}) CHECK(pace.after(now_s, frame_s) == 4);
  CHECK(pace.after(now_s, 0.1) == 2);
  // By now more than five are owed: two are enough.
  CHECK(pace.after(now_s, 0.21) == 2);
  CHECK(pace.after(now_s, 0.21) == 1);
  for (int frame = 0; frame < 5; ++frame) CHECK(pace.after(now_s, 5.0) == 1);
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

// Two seconds are more than a hundred frames.
TEST_CASE("Sampling grows at ninety frames a second and at a thousand too", "[pace]") {
  for (const double rate_Hz : {90.0, 1000.0}) {
    INFO(rate_Hz);
    Pace pace(kLadder, 1.0 / rate_Hz);
    double now_s = 0.0;
    const auto fly = [&](double span_s) {
      for (const double end_s = now_s + span_s; now_s < end_s; now_s += 1.0 / rate_Hz)
        pace.after(now_s, 0.02 * pace.samples() / rate_Hz);
    };
    fly(30.0);
    CHECK(pace.samples() == 8);
    for (int second = 0; second < 5; ++second) {
      pace.after(now_s, 0.9 / rate_Hz);
      fly(120.0 / rate_Hz);
    }
    CHECK(pace.samples() == 8);
    for (int frame = 0; frame < 2; ++frame) CHECK(pace.after(now_s, 0.9 / rate_Hz) == 8);
    CHECK(pace.after(now_s, 0.9 / rate_Hz) == 4);
  }
}

namespace {

// Inside 4 samples have room, outside 2.
class ByVolume {
 public:
  // How many frames were late.
  int fly(int frames, bool outside) {
    int late = 0;
    for (int i = 0; i < frames; ++i) {
      const double frame_s = outside ? 0.035 * samples() : 0.01 + 0.01 * samples();
      if (frame_s > Pace::kShare * kDeadline_s) ++late;
      samples_ = pace_.after(now_s_ += kDeadline_s, frame_s, outside);
    }
    return late;
  }
  double samples() const { return samples_; }

 private:
  fanbeam::live::PaceByVolume pace_{kLadder, kDeadline_s};
  double samples_ = pace_.samples(), now_s_ = 0.0;
};

}  // namespace

TEST_CASE("What is too slow outside the volume is coarser there alone", "[pace]") {
  ByVolume flight;
  flight.fly(300, false);
  REQUIRE(flight.samples() == 4);
  CHECK(flight.fly(50, true) == 3);
  CHECK(flight.samples() == 2);
  // Back inside no frame is late, and half a second later they are as fine as before.
  CHECK(flight.fly(10, false) == 0);
  CHECK(flight.samples() == 4);
  CHECK(flight.fly(40, false) == 0);
  CHECK(flight.samples() == 4);
  // What is known of outside holds for a while.
  CHECK(flight.fly(50, true) == 1);
  CHECK(flight.fly(150, false) == 0);
  CHECK(flight.samples() == 4);
  CHECK(flight.fly(50, true) == 3);
}

TEST_CASE("Frames in and out of the volume by turns become as coarse as outside needs", "[pace]") {
  ByVolume flight;
  flight.fly(300, false);
  REQUIRE(flight.samples() == 4);
  int late = 0;
  for (int i = 0; i < 100; ++i) {
    late += flight.fly(1, true) + flight.fly(1, false);
    if (i > 5) CHECK(flight.samples() == 2);
  }
  CHECK(late == 3);
  flight.fly(10, false);
  CHECK(flight.samples() == 4);
}

// Four samples take more than two let expect.
TEST_CASE(
    "A step that was too slow is left alone for ten seconds, then for twice as long each time",
    "[pace]") {
  Pace pace({2, 4}, kDeadline_s);
  double now_s = 0.0;
  std::vector<double> tried_s;
  const auto fly = [&](double span_s, double factor) {
    for (const double end_s = now_s + span_s; now_s < end_s; now_s += kDeadline_s) {
      const double before = pace.samples();
      if (pace.after(now_s, factor * (before == 4 ? 0.081 : 0.04)) > before)
        tried_s.push_back(now_s);
    }
  };
  fly(1000.0, 1.0);
  REQUIRE(tried_s.size() >= 7);
  for (std::size_t i = 1; i < tried_s.size(); ++i)
    CHECK(tried_s[i] - tried_s[i - 1] ==
          Approx(std::min(320.0, Pace::kPatience_s * std::exp2(static_cast<double>(i) - 1.0)))
              .epsilon(0.0)
              .margin(0.5));
  CHECK(pace.samples() == 2);
  // Until the load falls.
  fly(30.0, 0.7);
  CHECK(pace.samples() == 4);
}
