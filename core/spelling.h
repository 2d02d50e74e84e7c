// Suggestions for names that do not exist: which known names look most like the one that was
// written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

// Least number of inserted, removed or replaced bytes that turns one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// Up to `most` of the known names, nearest first, in the given order where equally near.
std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& known, std::size_t most);

}  // namespace fanbeam::core
