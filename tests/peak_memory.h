// How much memory a call makes this process hold.
#pragma once

#include <fstream>
#include <string>

namespace fanbeam::tests {

// Linux counts the peak over the whole life of the process: it is set back first, so that what
// earlier tests held does not hide a rise. proc(5), clear_refs and status.
class PeakMemory {
 public:
  PeakMemory() {
    std::ofstream("/proc/self/clear_refs") << "5";
    before_MiB_ = status_MiB("VmRSS:");
  }

  double rise_MiB() const { return status_MiB("VmHWM:") - before_MiB_; }

 private:
  static double status_MiB(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      double kiB = 0.0;
      if (word == key && status >> kiB) return kiB / 1024.0;
    }
    return 0.0;
  }

  double before_MiB_ = 0.0;
};

}  // namespace fanbeam::tests
