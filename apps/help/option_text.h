// What help, man pages and completion say of an option, taken from how it was declared to CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace fanbeam::apps {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; a single "SCENE" for an argument
  bool argument = false;           // known by its place, not by a name
  bool required = false;
  bool repeats = false;              // an argument given as often as one likes
  std::string value;                 // "NUMBER", "FOLDER"; empty for a flag
  std::vector<std::string> choices;  // all values there are
  std::vector<std::string> offered;  // what a comma-separated list may hold
  std::string sentence;              // what it does, with range, choices, default and company
};

OptionText text_of(const CLI::Option& option);

// Those that are shown: arguments first.
std::vector<OptionText> options_of(const CLI::App& command);

// Subcommands that are shown.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

// "fanbeam materials plot"
std::string path_of(const CLI::App& command);

}  // namespace fanbeam::apps
