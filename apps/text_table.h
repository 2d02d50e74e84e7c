// Text in columns for terminals: at most 100 characters a line.
#pragma once

#include <string>

namespace fanbeam::apps {

// `lead`, then the text beside it on as many lines as it takes.
std::string beside(const std::string& lead, const std::string& text);

}  // namespace fanbeam::apps
