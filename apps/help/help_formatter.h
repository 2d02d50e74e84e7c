// The text of --help: 80 columns, options with ranges and defaults, exit codes at the end.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace fanbeam::apps {

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_description(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_argument) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_expanded(const CLI::App* group) const override;  // of options
  std::string make_footer(const CLI::App* command) const override;
};

// "Examples:" and a line or two each; empty where there are none.
std::string examples_text(const CLI::App& command);

// Of a command, as examples_of takes it: its path without the program's name.
std::string key_of(const CLI::App& command);

}  // namespace fanbeam::apps
