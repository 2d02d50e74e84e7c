#include "apps/command_line.h"

#include <iostream>
#include <memory>
#include <utility>

#include "apps/help/help_formatter.h"
#include "apps/help/suggestion.h"
#include "apps/option_kinds.h"
#include "core/machine.h"
#include "session/version.h"

namespace fanbeam::apps {
namespace {

void add_common_options(CLI::App& command, CommonOptions& common) {
  command.set_version_flag(
      "--version", "fanbeam " + session::version_text() + " (" + session::commit_text() + ")");
  command.add_flag("-q,--quiet", common.quiet,
                   "No progress and no notes: only what was asked for, and errors");
  add_word(command, "--log-level", common.log_level, {"trace", "debug", "info", "warning", "error"},
           "Least message level shown")
      ->capture_default_str();
  add_word(command, "--isa", common.isa, {"v2", "v3", "v4"},
           "Use no instructions beyond this level of x86-64 (v2 SSE4.2, v3 AVX2, v4 "
           "AVX-512), in our kernels and in Embree, for pictures that machines of several "
           "kinds are to share (default: the campaign's or suite's own where there is one, else "
           "the best of this machine)");
}

}  // namespace

CommandLine::CommandLine()
    : program_(
          "fanbeam renders what an airborne imaging millimetre-wave radar sees on an approach.",
          "fanbeam") {
  program_.set_version_flag(
      "--version", "fanbeam " + session::version_text() + " (" + session::commit_text() + ")");
  program_.require_subcommand(1);
  program_.formatter(std::make_shared<HelpFormatter>());
}

void CommandLine::put(CLI::App& command, std::function<int()> action) {
  command.group(heading_);
  complete(command);
  actions_[&command] = std::move(action);
}

void CommandLine::complete(CLI::App& command) {
  add_common_options(command, common_);
  for (CLI::App* below : command.get_subcommands({})) {
    if (below->get_name().empty()) {
      below->set_help_flag();  // a group of options, which CLI11 gives a --help of its own
    } else {
      below->group("Commands");
      complete(*below);
    }
  }
}

int CommandLine::run(int argc, const char* const* argv) {
  try {
    program_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program_.exit(error);
    std::cerr << usage_error_text(program_, error);
    return kExitUsage;
  } catch (...) {  // of a file that an option names and that is read at once
    return run_guarded(
        [error = std::current_exception()]() -> int { std::rethrow_exception(error); });
  }
  const std::function<int()>& action = actions_.at(program_.get_subcommands().front());
  return run_guarded([&] {
    set_up_log(common_);
    core::limit_instructions(core::instruction_level_named(common_.isa), "--isa");
    return action();
  });
}

}  // namespace fanbeam::apps
