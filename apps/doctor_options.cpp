#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/doctor_command.h"
#include "apps/number_range.h"

namespace fanbeam::apps {

void add_doctor_command(CLI::App& app, DoctorOptions& options, CommonOptions& common) {
  CLI::App& command = *app.add_subcommand(
      "doctor", "Tell what makes a scene numerically delicate, why it matters and what to do");
  add_scene_choice(command, options);
  command.add_option("--json", options.json, "Write the findings to this file as well");
  command
      .add_option("--accuracy", options.accuracy_grey,
                  "Grey levels that will be asked for: is that possible?")
      ->check(number_from(0.01, 100.0))
      ->capture_default_str();
  command.add_flag("--measure", options.measure,
                   "Refine three frames to the accuracy as well and tell where it is not reached; "
                   "takes up to minutes");
  add_common_options(command, common);
  command.footer(
      "Exit codes: 0 nothing worse than delicate, 1 something is wrong, 3 invalid input");
}

}  // namespace fanbeam::apps
