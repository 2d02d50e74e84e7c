// fanbeam help: what there is, how a command is used, man pages and shell completion.
#pragma once

#include <string>
#include <vector>

#include "apps/common.h"

namespace fanbeam::apps {

struct HelpOptions {
  std::vector<std::string> command;  // "materials", "plot"; empty: all of them
  std::string man_pages;             // folder to write them to
  bool bash_completion = false;
};

// Returns an exit code: kExitUsage for a command that does not exist.
int help(const CLI::App& program, const HelpOptions& options);
CLI::App& add_help_command(CLI::App& program, HelpOptions& options);

}  // namespace fanbeam::apps
