#include "scenes/placed_problems.h"

#include <filesystem>

namespace fanbeam::scenes {

void append_placed(core::ProblemList& problems, const core::InputError& error,
                   const core::Place& place, const std::string& field) {
  for (core::Problem problem : error.problems()) {
    const bool has_place = problem.place.line > 0 || problem.place.byte_offset >= 0;
    if (!has_place && problem.is_error()) {
      std::string value = std::filesystem::path(problem.place.file).filename().string();
      if (!problem.field.empty()) value += (value.empty() ? "" : ", ") + problem.field;
      if (!problem.value.empty()) value += ": " + problem.value;
      problem.value = value;
      problem.field = field;
      problem.place = place;
    }
    problems.append({problem});
  }
}

}  // namespace fanbeam::scenes
