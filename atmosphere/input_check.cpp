#include "atmosphere/input_check.h"

#include <cmath>

namespace fanbeam::atmosphere {

namespace {

bool lies_in(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;  // NaN does not
}

core::ErrorClass class_of(double value) {
  return std::isfinite(value) ? core::ErrorClass::range : core::ErrorClass::nonfinite;
}

std::string span_text(double lowest, double highest) {
  return core::number_text(lowest) + " to " + core::number_text(highest);
}

}  // namespace

void check_range(core::ProblemList& problems, std::string_view field, double value,
                 const Range& range) {
  if (lies_in(value, range.lowest, range.highest)) return;
  std::string expected = span_text(range.lowest, range.highest);
  if (!range.unit.empty()) expected += " " + std::string(range.unit);
  problems.error(class_of(value), {}, std::string(field), core::number_text(value), expected);
}

void require_range(std::string_view field, double value, const Range& range) {
  core::ProblemList problems;
  check_range(problems, field, value, range);
  problems.throw_if_errors();
}

void check_frequency(core::ProblemList& problems, double frequency_Hz, double lowest_Hz,
                     double highest_Hz, std::string_view whose) {
  if (lies_in(frequency_Hz, lowest_Hz, highest_Hz)) return;
  std::string expected = span_text(lowest_Hz / 1e9, highest_Hz / 1e9) + " GHz";
  if (!whose.empty()) expected += " for " + std::string(whose);
  problems.error(class_of(frequency_Hz), {}, "frequency", GHz_text(frequency_Hz), expected);
}

void require_frequency(double frequency_Hz, double lowest_Hz, double highest_Hz,
                       std::string_view whose) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, lowest_Hz, highest_Hz, whose);
  problems.throw_if_errors();
}

std::string GHz_text(double frequency_Hz) { return core::number_text(frequency_Hz / 1e9) + " GHz"; }

}  // namespace fanbeam::atmosphere
