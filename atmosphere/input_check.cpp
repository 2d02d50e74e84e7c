#include "atmosphere/input_check.h"

#include <cmath>

#include "core/number_range.h"

namespace fanbeam::atmosphere {

void check_frequency(core::ProblemList& problems, double frequency_Hz, double lowest_Hz,
                     double highest_Hz, std::string_view whose) {
  const core::NumberRange range{lowest_Hz, highest_Hz};
  if (range.holds(frequency_Hz)) return;
  std::string expected =
      core::to_string(core::NumberRange{lowest_Hz / 1e9, highest_Hz / 1e9}) + " GHz";
  if (!whose.empty()) expected += " for " + std::string(whose);
  problems.error(
      std::isfinite(frequency_Hz) ? core::ErrorClass::range : core::ErrorClass::nonfinite, {},
      "frequency", GHz_text(frequency_Hz), expected);
}

void require_frequency(double frequency_Hz, double lowest_Hz, double highest_Hz,
                       std::string_view whose) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, lowest_Hz, highest_Hz, whose);
  problems.throw_if_errors();
}

std::string GHz_text(double frequency_Hz) { return core::number_text(frequency_Hz / 1e9) + " GHz"; }

}  // namespace fanbeam::atmosphere
