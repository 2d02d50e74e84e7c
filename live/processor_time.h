// Processor time by one of the system's clocks: CLOCK_PROCESS_CPUTIME_ID, or that of a thread.
#pragma once

#include <ctime>

namespace fanbeam::live {

inline double processor_time_s(clockid_t clock) {
  timespec spent{};
  ::clock_gettime(clock, &spent);
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

}  // namespace fanbeam::live
