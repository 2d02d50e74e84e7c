#include "atmosphere/input_check.h"

#include <cmath>

namespace fanbeam::atmosphere {

void check_range(core::ProblemList& problems, std::string_view field, double value,
                 const Range& range) {
  // Written so that NaN fails.
  if (value >= range.lowest && value <= range.highest) return;
  const auto error_class =
      std::isfinite(value) ? core::ErrorClass::range : core::ErrorClass::nonfinite;
  std::string expected =
      core::number_text(range.lowest) + " to " + core::number_text(range.highest);
  if (!range.unit.empty()) expected += " " + std::string(range.unit);
  problems.error(error_class, {}, std::string(field), core::number_text(value), expected);
}

void require_range(std::string_view field, double value, const Range& range) {
  core::ProblemList problems;
  check_range(problems, field, value, range);
  problems.throw_if_errors();
}

}  // namespace fanbeam::atmosphere
