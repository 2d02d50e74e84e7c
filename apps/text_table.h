// Text in columns for terminals: at most 100 characters a line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fanbeam::apps {

// At blanks, at most `width` characters a line; longer words are cut. At least one line.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

// `lead`, then the text beside it on as many lines as it takes.
std::string beside(const std::string& lead, const std::string& text);

}  // namespace fanbeam::apps
