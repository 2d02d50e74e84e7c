// One line of the table of targets.
#pragma once

#include <string>
#include <vector>

namespace fanbeam::benchmarks {

// What is asked of a value, and which way it counts.
struct Target {
  double must = 0.0;
  double aim = 0.0;  // as `must` where there is none
  bool at_least = false;
};

// Why a target is missed where it is, in words that stand in a table: reasons.h.
struct Reason {
  const char* text;
};

// Values are judged as they are added; the worst decides.
class TargetRow {
 public:
  // `must` and `aim` empty: there is none.
  TargetRow(std::string what, Reason why, std::string must, std::string aim = "");

  // Text of one measured figure, for the column that lists them.
  void add(const std::string& measured);
  void judge(double value, const Target& target);
  void miss() { verdict_ = Verdict::missed; }
  bool missed() const { return verdict_ == Verdict::missed; }
  std::string markdown() const;
  // The same for the list of what was missed: the reason in place of the verdict.
  std::string missed_markdown() const { return markdown_ending(why_); }

 private:
  enum class Verdict { aim_met, must_met, missed };

  std::string markdown_ending(const std::string& last) const;

  std::string what_, why_, must_, aim_, measured_;
  Verdict verdict_ = Verdict::aim_met;
};

using TargetRows = std::vector<TargetRow>;

inline void add_rows(TargetRows& rows, const TargetRows& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

// Without a head.
std::string markdown_of(const TargetRows& rows);

}  // namespace fanbeam::benchmarks
