// What other programs take of the processor while figures are measured: it spoils times.
#pragma once

#include <chrono>

namespace fanbeam::benchmarks {

class MachineLoad {
 public:
  // Counts from now on.
  MachineLoad();
  // Cores that were busy with anything but this program and what it started, on average since
  // then; 0 where the system does not tell (Linux does).
  double other_cores() const;

 private:
  std::chrono::steady_clock::time_point begin_;
  double all_s_ = 0.0;  // processor time of everything, since the machine started
  double own_s_ = 0.0;
};

}  // namespace fanbeam::benchmarks
