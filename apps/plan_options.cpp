#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/option_lists.h"
#include "apps/plan_command.h"
#include "apps/value_words.h"
#include "core/text.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

CLI::App& add_plan_command(CLI::App& program, PlanOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "plan", "Tell which effects a scene calls for, why, how much each can change, and its cost");
  add_scene_choice(command, options);
  command.add_flag("--json", options.json, "The same as JSON (docs/plan.md has its keys)");
  add_accuracy_option(command, options.accuracy_grey,
                      "Grey levels asked for: half of it is for effects left out, half for "
                      "sampling (default: the scene's, else " +
                          core::number_text(scenes::kDefaultAccuracy_grey) + ")");
  add_effects_option(command, options.effects, renderer::Touches::pictures);
  command
      .add_option("--products", options.products,
                  "What frames are wanted for, as of fanbeam render: detections, power, "
                  "labels and obstacles ask for more effects (default bscope,cscope)")
      ->type_name("PRODUCT")
      ->check(offers(names_of(session::kProducts)));
  command.add_flag("--per-frame", options.per_frame,
                   "Tell as well what single frames can go without");
  CLI::Option* measure = command.add_flag(
      "--measure", options.measure,
      "Measure what each effect costs in milliseconds a frame: on against off, in turn, over three "
      "frames; takes minutes");
  add_frames_option(command, options.frames,
                    std::string("Frames for --per-frame and --measure: ") + kFramesText)
      ->default_str("all");
  add_threads_option(command, options.threads);
  command.add_option("--repetitions", options.repetitions, "Of each measured frame")
      ->check(whole_number_from(1, 10000))
      ->needs(measure)
      ->group("");  // for tests and the impatient: a cost that is told elsewhere wants 20
  command.callback([&options] {
    if (!options.frames.empty() && !options.per_frame && !options.measure)
      throw CLI::ValidationError(
          "--frames",
          "only chooses frames of --per-frame and --measure; the plan itself is that "
          "of the whole sequence");
  });
  return command;
}

}  // namespace fanbeam::apps
