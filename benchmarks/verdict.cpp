#include "benchmarks/verdict.h"

#include <fmt/core.h>

#include <algorithm>

namespace fanbeam::benchmarks {

TargetRow::TargetRow(std::string what, Reason why, std::string must, std::string aim)
    : what_(std::move(what)), why_(why.text), must_(std::move(must)), aim_(std::move(aim)) {}

void TargetRow::add(const std::string& measured) {
  if (!measured_.empty()) measured_ += "; ";
  measured_ += measured;
}

void TargetRow::judge(double value, const Target& target) {
  const auto holds = [&](double limit) {
    return target.at_least ? value >= limit : value <= limit;
  };
  verdict_ = std::max(verdict_, holds(target.aim)    ? Verdict::aim_met
                                : holds(target.must) ? Verdict::must_met
                                                     : Verdict::missed);
}

std::string TargetRow::markdown() const {
  if (missed()) return markdown_ending("missed");
  return markdown_ending(verdict_ == Verdict::aim_met && !aim_.empty() ? "aim met" : "must met");
}

std::string TargetRow::markdown_ending(const std::string& last) const {
  const auto or_dash = [](const std::string& text) {
    return text.empty() ? std::string("-") : text;
  };
  return fmt::format("| {} | {} | {} | {} | {} |\n", what_, or_dash(must_), or_dash(aim_),
                     measured_, last);
}

std::string markdown_of(const TargetRows& rows) {
  std::string out;
  for (const TargetRow& row : rows) out += row.markdown();
  return out;
}

}  // namespace fanbeam::benchmarks
