// Median times of one thing; of several that are compared: core/turns.h.
#pragma once

#include <chrono>
#include <vector>

#include "core/turns.h"

namespace fanbeam::measure {

using Clock = std::chrono::steady_clock;

inline double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Repeats `least` times, then on until `most` repetitions or `most_ms` are spent.
struct Repetitions {
  int least = 11;
  int most = 21;
  double most_ms = 600.0;
  bool warm_up = true;  // once before, not counted
};

template <class Work>
core::MedianTime time_of(const Repetitions& repetitions, const Work& work) {
  if (repetitions.warm_up) work();
  std::vector<double> times_ms;
  double spent_ms = 0.0;
  for (int i = 0; i < repetitions.most; ++i) {
    if (i >= repetitions.least && spent_ms >= repetitions.most_ms) break;
    const Clock::time_point begin = Clock::now();
    work();
    times_ms.push_back(milliseconds_since(begin));
    spent_ms += times_ms.back();
  }
  return core::median_of(std::move(times_ms));
}

}  // namespace fanbeam::measure
