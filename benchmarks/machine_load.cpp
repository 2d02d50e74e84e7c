#include "benchmarks/machine_load.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace fanbeam::benchmarks {
namespace {

double all_s() {
  std::ifstream stream("/proc/stat");
  std::string name;
  double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, waiting = 0.0;
  double interrupts = 0.0, soft_interrupts = 0.0, stolen = 0.0;
  stream >> name >> user >> nice >> system >> idle >> waiting >> interrupts >> soft_interrupts >>
      stolen;
  return (user + nice + system + interrupts + soft_interrupts + stolen) /
         static_cast<double>(sysconf(_SC_CLK_TCK));
}

double own_s() {
  double sum_s = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum_s += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum_s;
}

}  // namespace

MachineLoad::MachineLoad()
    : begin_(std::chrono::steady_clock::now()), all_s_(all_s()), own_s_(own_s()) {}

double MachineLoad::other_cores() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  const double other_s = (all_s() - all_s_) - (own_s() - own_s_);
  return elapsed.count() > 0.0 ? std::max(0.0, other_s / elapsed.count()) : 0.0;
}

}  // namespace fanbeam::benchmarks
