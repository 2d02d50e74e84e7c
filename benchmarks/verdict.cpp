#include "benchmarks/verdict.h"

#include <fmt/core.h>

#include <algorithm>

namespace fanbeam::benchmarks {

TargetRow::TargetRow(std::string what, std::string must, std::string aim)
    : what_(std::move(what)), must_(std::move(must)), aim_(std::move(aim)) {}

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
  const char* verdict = "missed";
  if (verdict_ != Verdict::missed)
    verdict = verdict_ == Verdict::aim_met && !aim_.empty() ? "aim met" : "must met";
  const auto or_dash = [](const std::string& text) {
    return text.empty() ? std::string("-") : text;
  };
  return fmt::format("| {} | {} | {} | {} | {} |\n", what_, or_dash(must_), or_dash(aim_),
                     measured_, verdict);
}

}  // namespace fanbeam::benchmarks
