// Suggestions for names that do not exist: which known names look most like the one that was
// written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

// Least number of inserted, removed or replaced bytes and of swapped neighbours that turns one text into the
// other, no byte changed twice (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

// Up to `most` of the known names, nearest first, in the given order where equally near.
std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& known, std::size_t most);

// For messages about a name that a file should have and does not: what it has, in the file's order,
// and the likely meant one when there is any: "; perhaps height_ft of time_s, latitude_deg,
// height_ft", "; there are time_s, x and 12 more", "; there are none". A likely one contains the
// wanted name, lies in it with three letters or more, or differs from it by half of its letters at most; of
// several the one that contains it or differs least, where three letters around a name count as one. At most a thousand
// names are looked at; a loop over a hostile file asks only while its problems are still listed. Without a wanted name
// none is likely.
std::string names_there_text(std::string_view wanted, const std::vector<std::string>& known);

}  // namespace fanbeam::core
