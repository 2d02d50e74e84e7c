#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/validate_command.h"

namespace fanbeam::apps {

CLI::App& add_validate_command(CLI::App& program, ValidateOptions& options) {
  CLI::App& command =
      *program.add_subcommand("validate", "Check a scene and report every problem at once");
  add_scene_choice(command, options);
  return command;
}

}  // namespace fanbeam::apps
