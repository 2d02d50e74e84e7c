// Guards against work that grows with a hostile number: code that falls for it takes minutes, or
// all memory there is. The processor's time counts, which other programs hardly lengthen.
#pragma once

#include <ctime>

namespace fanbeam::tests {

// Of this process so far.
inline double processor_time_s() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

// What is refused "at once" takes milliseconds; the rest is room for slow machines.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr double kAtOnce_s = 100.0;
inline constexpr double kSanitizerMemory = 10.0;  // factor for limits of memory
inline constexpr int kRandomInputs = 100'000;
#else
inline constexpr double kAtOnce_s = 5.0;
inline constexpr double kSanitizerMemory = 1.0;
inline constexpr int kRandomInputs = 1'000'000;
#endif

}  // namespace fanbeam::tests
