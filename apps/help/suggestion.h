// What to say of a command line that cannot be understood.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace fanbeam::apps {

// "fanbeam: no command rendr; did you mean render?"; with all commands when none looks alike.
std::string no_such_command(const CLI::App& parent, const std::string& word);

// The message for what parse() threw, with a line feed at its end: unknown words first, each with
// what it may have meant, for they often cause the rest.
std::string usage_error_text(const CLI::App& program, const CLI::ParseError& error);

}  // namespace fanbeam::apps
