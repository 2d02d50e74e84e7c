// What a list of problems says.
#pragma once

#include <string>

#include "core/errors.h"

namespace fanbeam::tests {

// A line for each.
inline std::string all_of(const core::ProblemList& problems) {
  std::string text;
  for (const core::Problem& problem : problems.all()) text += core::to_string(problem) + "\n";
  return text;
}

}  // namespace fanbeam::tests
