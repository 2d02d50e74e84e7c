#include "scenes/trajectory/trajectory_checks.h"

#include <cmath>
#include <string>

#include "core/errors.h"

namespace fanbeam::scenes {

void check_in(core::ProblemList& problems, const char* field, double value, double lowest,
              double highest) {
  if (value >= lowest && value <= highest) return;
  const auto error_class =
      std::isfinite(value) ? core::ErrorClass::range : core::ErrorClass::nonfinite;
  problems.error(error_class, {}, field, core::number_text(value),
                 core::number_text(lowest) + " to " + core::number_text(highest));
}

}  // namespace fanbeam::scenes
