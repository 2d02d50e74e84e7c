// Progress of long work: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace fanbeam::apps {

class Progress {
 public:
  // Silent when `quiet`. Writes to standard error.
  Progress(std::string what, int total, bool quiet, std::string things = "frames");
  ~Progress();

  void step(int done);

 private:
  void draw_bar(int done, double rate, double left_s);

  std::string what_;
  std::string things_;
  int total_;
  bool quiet_;
  bool terminal_;
  int next_line_percent_ = 10;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point last_drawn_;
};

}  // namespace fanbeam::apps
