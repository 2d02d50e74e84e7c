#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/cost_command.h"
#include "apps/number_check.h"

namespace fanbeam::apps {

CLI::App& add_cost_command(CLI::App& program, CostOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "cost", "Measure what accuracy and effects cost in time: CSV, plots and a page of tables");
  command.footer(
      "Takes minutes: converged pictures come first, 10 s to well over a minute each on two "
      "cores, longest over a city. Leave the machine alone meanwhile.");
  add_scene_choice(command, options);
  add_output_option(command, options.output, "Folder to write to (default out/<scene name>-cost)");
  add_frames_option(command, options.frames,
                    std::string(kFramesText) +
                        " (default: two, at a quarter and at three quarters of the approach)");
  command
      .add_option(
          "--parts", options.parts,
          "What to measure: ladder (error against time of every way of sampling), effects "
          "(each left out or forced on), numerics (range in float or double, robust flag, "
          "sub-columns of the beam), levels (the B-scope from powers and from beat signals)")
      ->delimiter(',')
      ->check(CLI::IsMember({"ladder", "effects", "numerics", "levels"}))
      ->capture_default_str();
  command
      .add_option("--repetitions", options.repetitions,
                  "Repetitions of every timing after a warm-up (default 20, or 3 with --quick)")
      ->check(whole_number_from(1, 10000));
  command.add_flag("--quick", options.quick,
                   "A short look: fewer steps and repetitions, a coarse reference");
  add_caster_option(command, options.caster,
                    "Way to sample the frames in which effects are measured (default: the scene's, "
                    "else auto)");
  add_threads_option(command, options.threads);
  return command;
}

}  // namespace fanbeam::apps
