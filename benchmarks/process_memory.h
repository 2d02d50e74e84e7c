// Memory of a process, from Linux.
#pragma once

#include <sys/types.h>

#include <string>

namespace fanbeam::benchmarks {

// A line of /proc/PID/status, "VmHWM" or "VmRSS", of this process where `process` is 0. 0 where there
// is none, as of a process that has ended.
double process_memory_bytes(const std::string& field, pid_t process = 0);

}  // namespace fanbeam::benchmarks
