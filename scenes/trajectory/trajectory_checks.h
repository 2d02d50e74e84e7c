// Private to the flight paths: is a parameter finite and inside its range?
#pragma once

namespace fanbeam::core {
class ProblemList;
}

namespace fanbeam::scenes {

// Adds E-NONFINITE or E-RANGE to `problems` when `value` is outside [lowest, highest].
void check_in(core::ProblemList& problems, const char* field, double value, double lowest,
              double highest);

}  // namespace fanbeam::scenes
