// Time limits of tests count the processor's time, which other programs do not lengthen; a
// sanitizer does.
#pragma once

#include <ctime>

namespace fanbeam::tests {

// Of this process so far.
inline double processor_time_s() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

// Factor for limits of time, and of memory with it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr double kSanitizerSlowdown = 10.0;
#else
inline constexpr double kSanitizerSlowdown = 1.0;
#endif

}  // namespace fanbeam::tests
