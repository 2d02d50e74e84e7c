// Numbers in the rows of airport data, with everything that is wrong told under its line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/config_table.h"
#include "core/errors.h"

namespace fanbeam::scenes {

// The number in `text`. E-PARSE, E-NONFINITE or E-RANGE at `place` for anything else; then nothing.
std::optional<double> airport_number(std::string_view text, const std::string& field,
                                     const core::NumberRange& range, const char* unit,
                                     const core::Place& place, core::ProblemList& problems);

// The same for a code, a whole number.
std::optional<int> airport_code(std::string_view text, const std::string& field, int least,
                                int most, const core::Place& place, core::ProblemList& problems);

inline constexpr core::NumberRange kLatitude_deg{-90, 90}, kLongitude_deg{-180, 180},
    kElevation_m{-500, 6000}, kDisplaced_m{0, 3000}, kWidth_m{5, 200};

}  // namespace fanbeam::scenes
