// Progress of long work, on standard error: a bar on a terminal, plain lines elsewhere. Silent when `quiet`.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace fanbeam::apps {

// What every kind of it shares.
class ProgressLine {
 public:
  ProgressLine(std::string what, bool quiet);
  ~ProgressLine();  // leaves the line of the bar
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

 protected:
  static constexpr int kWidth = 30;

  bool quiet() const { return quiet_; }
  bool terminal() const { return terminal_; }
  double elapsed_s() const;
  // `filled` of kWidth.
  void draw_bar(int filled, const std::string& text) const;
  void print_line(const std::string& text) const;

 private:
  std::string what_;
  bool quiet_, terminal_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// Of things that take alike.
class Progress : public ProgressLine {
 public:
  Progress(std::string what, int total, bool quiet, std::string things = "frames");

  void step(int done);

 private:
  std::string things_;
  int total_;
  int next_line_percent_ = 10;
  double last_drawn_s_ = 0.0;
};

// What hears how many of how many frames are done, first of none: it makes `bar` with the first.
std::function<void(int, int)> frames_progress(std::optional<Progress>& bar, std::string what,
                                              bool quiet);

// Of steps that take very different times, weighed by what they are expected to take.
class CostProgress : public ProgressLine {
 public:
  // `total_s` in all.
  CostProgress(std::string what, double total_s, bool quiet);

  // Ends the step before.
  void begin(const std::string& step, double expected_s);

 private:
  double total_s_;
  double done_s_ = 0.0, step_s_ = 0.0;
};

// "45 s", "3 min".
std::string duration_text(double seconds);

}  // namespace fanbeam::apps
