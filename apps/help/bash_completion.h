// Completion for bash from the declared commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace fanbeam::apps {

// A script to source, or to install as share/bash-completion/completions/fanbeam. It completes
// commands, options and their values; scenes, sensors and materials it asks the program for, files
// and folders the shell. Needs bash 4 and no library of completion functions.
std::string bash_completion(const CLI::App& program);

}  // namespace fanbeam::apps
