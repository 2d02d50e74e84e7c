// fanbeam plan: which effects a scene calls for, why, and what they cost.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <string>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/option_lists.h"
#include "apps/plan_table.h"
#include "apps/scene_choice.h"
#include "core/parallel.h"
#include "core/text.h"
#include "scenes/scene.h"
#include "session/frame_choice.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

struct PlanOptions : SceneChoice {
  std::string frames;  // as of fanbeam render; those looked at with per_frame and measure
  std::string effects;
  std::string products;        // that frames are wanted for; empty: B-scope and C-scope
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  int threads = 0;
  bool json = false;
  bool per_frame = false;
  bool measure = false;
  int repetitions = 20;
};

CLI::App& declare_plan(CLI::App& program, PlanOptions& options) {
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
  add_whole_number(command, "--repetitions", options.repetitions, {1, 10000},
                   "Of each measured frame")
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

int explain_plan(const PlanOptions& options, const CommonOptions& common) {
  const core::ThreadLimit threads(options.threads);
  core::ProblemList problems;
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  if (!options.effects.empty()) build.wishes = renderer::parse_effect_wishes(options.effects);
  if (!options.products.empty())
    session::plan_for(products_in(options.products, session::kProducts), build);
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  const auto scene = session::Session(description, {.build = build}, problems).scene();
  if (!common.quiet) print_problems(problems.all());
  const bool by_frames = options.per_frame || options.measure || !options.frames.empty();
  const std::vector<int> frames =
      by_frames ? session::parse_frames(options.frames, scene->frame_count()) : std::vector<int>();
  measure::PlanReport report{*scene};
  if (options.per_frame) measure::plan_frames(frames, report);
  if (options.measure)
    report.measured = measure::measure_plan(*scene, frames, options.repetitions, [&](int done) {
      if (!common.quiet)
        fmt::print(stderr, "measured {} of {} effects\n", done, scene->plan.decisions.size());
    });
  fmt::print("{}", options.json ? measure::plan_json(report) : plan_table(report, !common.quiet));
  return kExitDone;
}

}  // namespace

void add_plan(CommandLine& line) { line.add(declare_plan, explain_plan); }

}  // namespace fanbeam::apps
