// The clock of all measurements; medians of what is compared: core/turns.h.
#pragma once

#include <chrono>

namespace fanbeam::measure {

using Clock = std::chrono::steady_clock;

inline double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace fanbeam::measure
