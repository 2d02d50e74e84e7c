// One line of the table of targets.
#pragma once

#include <string>

namespace fanbeam::benchmarks {

// What is asked of a value, and which way it counts.
struct Target {
  double must = 0.0;
  double aim = 0.0;  // as `must` where there is none
  bool at_least = false;
};

// Values are judged as they are added; the worst decides.
class TargetRow {
 public:
  // Empty: there is none.
  TargetRow(std::string what, std::string must, std::string aim = "");

  // Text of one measured figure, for the column that lists them.
  void add(const std::string& measured);
  void judge(double value, const Target& target);
  void miss() { verdict_ = Verdict::missed; }
  std::string markdown() const;

 private:
  enum class Verdict { aim_met, must_met, missed };

  std::string what_, must_, aim_, measured_;
  Verdict verdict_ = Verdict::aim_met;
};

}  // namespace fanbeam::benchmarks
