#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/doctor_command.h"
#include "apps/value_words.h"
#include "core/text.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

CLI::App& add_doctor_command(CLI::App& program, DoctorOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "doctor", "Tell what makes a scene numerically delicate, why it matters and what to do");
  add_scene_choice(command, options);
  command.add_option("--json", options.json, "Write the findings to this file as well")
      ->type_name(kFileValue);
  add_accuracy_option(
      command, options.accuracy_grey,
      "Grey levels that will be asked for: is that possible? (default: the scene's, else " +
          core::number_text(scenes::kDefaultAccuracy_grey) + ")");
  command.add_flag("--measure", options.measure,
                   "Refine three frames to the accuracy as well and tell where it is not reached; "
                   "takes up to minutes");
  return command;
}

}  // namespace fanbeam::apps
