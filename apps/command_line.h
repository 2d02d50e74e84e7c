// The command line: the commands with what each takes and what it runs.
//
// A command is a struct of options and two functions, which its add_x (apps/commands.h) hands to
// CommandLine::add: one declares the options to CLI11, the other runs with what was given. Help, man pages and shell
// completion follow from what was declared. An option that would do nothing beside the others given
// is refused, with exit code 2.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

// Options that several commands have, each with the same name, values and limits wherever it is asked for.
// `what` is what help says of it.
CLI::Option* add_accuracy_option(CLI::App& command, double& accuracy_grey, const std::string& what);
void add_caster_option(CLI::App& command, std::string& caster, const std::string& what);
void add_output_option(CLI::App& command, std::string& folder, const std::string& what);
void add_seed_option(CLI::App& command, std::uint64_t& seed);
void add_threads_option(CLI::App& command, int& threads);

// As session::parse_frames takes them; kFramesText is part of what help says.
inline constexpr const char* kFramesText = "A:B[:STEP], counted like a Python slice, or one frame";
CLI::Option* add_frames_option(CLI::App& command, std::string& frames, const std::string& what);

// `order`: when that folder is looked at.
inline constexpr const char* kDataOrder = "looked at before the one that FANBEAM_DATA names";
void add_data_option(CLI::App& command, std::string& folder, const std::string& order);

class CommandLine {
 public:
  CommandLine();

  // What is added from here on stands under this heading in overviews.
  void heading(std::string text) { heading_ = std::move(text); }

  // declare(CLI::App& program, Options&) adds a subcommand with its options and returns it; what every
  // command has is added to it and those below. action(const Options&, const CommonOptions&) gives an exit
  // code.
  template <class Options, class Run>
  void add(CLI::App& (*declare)(CLI::App&, Options&), Run action) {
    const auto options = std::make_shared<Options>();
    put(declare(program_, *options), [this, options, action] { return action(*options, common_); });
  }

  // Reads the command line and runs what it asks for. Returns the program's exit code; what went
  // wrong is on standard error.
  int run(int argc, const char* const* argv);

  const CLI::App& program() const { return program_; }

 private:
  void put(CLI::App& command, std::function<int()> action);
  // --version, --quiet, --log-level and --isa, for the command and those below (--help is CLI11's).
  void complete(CLI::App& command);

  CLI::App program_;
  CommonOptions common_;
  std::string heading_;
  std::map<const CLI::App*, std::function<int()>> actions_;
};

}  // namespace fanbeam::apps
