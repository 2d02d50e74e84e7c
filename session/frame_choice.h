// Which frames of a sequence a command looks at.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fanbeam::session {

// The frames that "A:B[:STEP]" selects of `count`, as Python's range(count)[A:B:STEP] with STEP
// above 0; a single number is that frame. Throws InputError E-PARSE or E-RANGE.
std::vector<int> parse_frames(const std::string& text, int count);

// Throws what parse_frames throws however many frames there are.
void check_frames(const std::string& text);

// Up to `count` of the frames, at the middles of equal parts.
std::vector<int> spread_over(const std::vector<int>& frames, std::size_t count);

}  // namespace fanbeam::session
