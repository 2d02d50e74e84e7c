// What options alone do not say of a command: examples, and what its exit codes mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::apps {

struct Example {
  std::string_view line;  // as typed
  std::string_view what;  // comes of it
};

// Of a command by its path, "materials plot", or of the program itself, "".
std::vector<Example> examples_of(std::string_view command);

struct ExitCode {
  std::string codes;    // "130 or 143"
  std::string meaning;  // in a word or two
  std::string detail;   // for man pages; may be empty
};

// All that the command can end with, in rising order.
std::vector<ExitCode> exit_codes_of(std::string_view command);

}  // namespace fanbeam::apps
