// Progress of work whose steps take very different times: a bar on a terminal, plain lines
// elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace fanbeam::apps {

class CostProgress {
 public:
  // Steps are weighed by what they are expected to take, `total_s` in all. Silent when `quiet`.
  // Writes to standard error.
  CostProgress(std::string what, double total_s, bool quiet);
  ~CostProgress();
  CostProgress(const CostProgress&) = delete;
  CostProgress& operator=(const CostProgress&) = delete;

  // Ends the step before.
  void begin(const std::string& step, double expected_s);

 private:
  std::string what_;
  double total_s_;
  bool quiet_, terminal_;
  double done_s_ = 0.0, step_s_ = 0.0;
  std::chrono::steady_clock::time_point begin_;
};

// "45 s", "3 min".
std::string duration_text(double seconds);

}  // namespace fanbeam::apps
