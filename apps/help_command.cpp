// fanbeam help: what there is, how a command is used, man pages and shell completion.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/help/bash_completion.h"
#include "apps/help/help_formatter.h"
#include "apps/help/man_page.h"
#include "apps/help/option_text.h"
#include "apps/help/suggestion.h"
#include "apps/option_kinds.h"

namespace fanbeam::apps {
namespace {

struct HelpOptions {
  std::vector<std::string> command;  // "materials", "plot"; empty: all of them
  std::string man_pages;             // folder to write them to
  bool bash_completion = false;
};

CLI::App& declare_help(CLI::App& program, HelpOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "help", "Tell what there is, or how a command is used, with examples");
  CLI::Option* name =
      command.add_option("COMMAND", options.command, "Such as render, or materials plot")
          ->type_name(kCommandValue);
  CLI::Option* completion =
      command
          .add_flag("--bash-completion", options.bash_completion,
                    "Print a script for bash that completes commands, options and their values")
          ->excludes(name);
  add_folder(command, "--man-pages", options.man_pages,
             "Write a manual page for each command there")
      ->excludes(name)
      ->excludes(completion);
  return command;
}

const CLI::App* below(const CLI::App& parent, const std::string& name) {
  for (const CLI::App* command : commands_of(parent))
    if (command->get_name() == name) return command;
  return nullptr;
}

int help(const CLI::App& program, const HelpOptions& options) {
  if (!options.man_pages.empty()) {
    write_man_pages(program, options.man_pages);
    return kExitDone;
  }
  if (options.bash_completion) {
    fmt::print("{}", bash_completion(program));
    return kExitDone;
  }
  const CLI::App* command = &program;
  for (const std::string& name : options.command) {
    const CLI::App* next = below(*command, name);
    if (next == nullptr) {
      std::cerr << no_such_command(*command, name);
      return kExitUsage;
    }
    command = next;
  }
  fmt::print(
      "{}{}",
      program.get_formatter()->make_help(command, path_of(*command), CLI::AppFormatMode::Normal),
      examples_text(*command));
  return kExitDone;
}

}  // namespace

void add_help(CommandLine& line) {
  line.add(declare_help, [&line](const HelpOptions& options, const CommonOptions&) {
    return help(line.program(), options);
  });
}

}  // namespace fanbeam::apps
