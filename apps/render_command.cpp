#include "apps/render_command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <optional>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/option_lists.h"
#include "apps/progress.h"
#include "apps/render_summary.h"
#include "apps/stop_on_signals.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"
#include "session/figure/figure_facts.h"
#include "session/products/preview.h"
#include "session/sequence.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

void add_sampling(CLI::App& command, RenderOptions& options) {
  CLI::Option* rays =
      add_number(command, "--rays-per-cell", options.rays_per_cell, renderer::kSamplesPerCell,
                 "Rays per range cell and column, or azimuth slices per column (fractions: the "
                 "next whole number, with fewer rays for bounces): more is sharper and slower "
                 "(default: the scene's accuracy, else " +
                     core::number_text(renderer::kDefaultRaysPerCell) + " rays or " +
                     core::number_text(renderer::kDefaultSlicesPerColumn) + " slices)");
  CLI::Option* accuracy = add_accuracy_option(
      command, options.accuracy_grey,
      "Error allowed, RMS in grey levels: half of it is for effects left out, half for sampling, "
      "which is refined frame by frame until its estimate says so; with --rays-per-cell for "
      "effects alone (one grey level is 0.24 dB with the default display; default: the scene's)");
  CLI::Option* budget =
      add_number(command, "--time-budget", options.time_budget_ms, renderer::kTimeBudgets_ms,
                 "Milliseconds a frame may take from pose to pictures in memory (16 Hz: "
                 "62.5): the finest sampling that fits, and the error it reaches; with "
                 "--accuracy no finer than that needs (default: the scene's)")
          ->excludes(rays);
  CLI::Option* estimate =
      command.add_flag("--estimate-error", options.estimate_error,
                       "Estimate every frame's sampling error, for run.json; takes twice the "
                       "time with rays, three times with slices");
  estimate->excludes(accuracy)->excludes(budget);
  add_caster_option(
      command, options.caster,
      "rays: any geometry, the reference; profile: azimuth slices in closed form, over "
      "buildings or with double bounce as close in half to all of the rays' time; auto: slices "
      "where they apply and pay (default: the scene's, else auto)");
  command
      .add_flag(
          "--reference", options.reference,
          "Converged sampling, always with rays: 256 azimuths per column x 8 rays per cell; 10 s "
          "to well over a minute a frame on two cores, longest over a city")
      ->excludes(rays)
      ->excludes(accuracy)
      ->excludes(budget)
      ->excludes(estimate);
  add_word(command, "--realisation", options.realisation, {"mean", "sample"},
           "mean: expected power, and so without --effects +speckle or +swerling; sample: one "
           "draw with speckle, noise and fluctuating targets (default: the scene's)");
  add_seed_option(command, options.seed);
  command.callback([&options] {
    if (options.reference && options.caster == name_of(renderer::CasterWish::profile))
      throw CLI::ValidationError(
          "--caster profile",
          "--reference is what all errors are stated against, and always made of rays; leave out "
          "one of the two, or take --caster profile with a large --rays-per-cell");
  });
}

CLI::App& declare_render(CLI::App& program, RenderOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "render", "Render a scene's approach to B-scope and C-scope pictures");
  add_scene_choice(command, options);
  add_output_option(command, options.output, "Folder to write to (default out/<scene name>)");
  add_frames_option(command, options.frames, std::string(kFramesText) + " (default: all)");
  command.add_option("--products", options.products, products_help(session::kProducts))
      ->type_name("PRODUCT")
      ->check(offers(names_of(session::kProducts)))
      ->capture_default_str();
  add_threads_option(command, options.threads);
  add_sampling(command, options);
  add_effects_option(command, options.effects, renderer::Touches::pictures);
  command.add_flag("--plan-per-frame", options.plan_per_frame,
                   "Leave out of each frame what it can do without, not only what the whole "
                   "sequence can; no pixel changes by more than half the accuracy");
  command.add_flag(
      "--resume", options.resume,
      "Do not render again what an earlier run with the same input has finished; frames "
      "of another input are removed at the end");
  command.add_flag("--overwrite", options.overwrite,
                   "Write to a folder that holds other files too: frames of other renders there "
                   "are removed, other files stay (a run's own record is always replaced)");
  add_word(
      command, "--preview-format", options.preview_format,
      std::vector<std::string>(session::kPreviewFormats.begin(), session::kPreviewFormats.end()),
      "Form of the preview")
      ->default_str(session::SequenceSettings{}.preview_format);
  add_word(command, "--range-unit", options.range_unit,
           std::vector<std::string>(session::kRangeUnits.begin(), session::kRangeUnits.end()),
           "Of the range scale of figure and ppi_figure (default: km for sensors that see "
           "beyond 2 km, else "
           "m)");
  return command;
}

scenes::BuildOptions build_options(const RenderOptions& options,
                                   const session::ProductSet& products) {
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  session::plan_for(products, build);
  if (!options.effects.empty()) build.wishes = renderer::parse_effect_wishes(options.effects);
  if (options.reference) {
    build.caster = renderer::CasterWish::rays;
  } else if (!options.caster.empty()) {
    build.caster = renderer::caster_wish(options.caster);
  }
  return build;
}

session::SequenceSettings sequence_of(const RenderOptions& options,
                                      const session::ProductSet& products) {
  session::SequenceSettings settings{.output = options.output,
                                     .frames = options.frames,
                                     .products = products,
                                     .sampling = options,
                                     .range_unit = options.range_unit,
                                     .plan_per_frame = options.plan_per_frame,
                                     .resume = options.resume,
                                     .overwrite = options.overwrite};
  if (!options.preview_format.empty()) settings.preview_format = options.preview_format;
  return settings;
}

// Of products that nobody asked for they would be ignored in silence.
void refuse_options_without_product(const RenderOptions& options,
                                    const session::ProductSet& products) {
  core::ProblemList problems;
  if (!options.range_unit.empty() && !products.contains("figure") &&
      !products.contains("ppi_figure"))
    problems.error(core::ErrorClass::ref, {}, "--range-unit", options.range_unit,
                   "figure or ppi_figure among --products");
  if (!options.preview_format.empty() && !products.contains("preview"))
    problems.error(core::ErrorClass::ref, {}, "--preview-format", options.preview_format,
                   "preview among --products");
  problems.throw_if_errors();
}

}  // namespace

int render(const RenderOptions& asked, const CommonOptions& common) {
  const session::ProductSet products = products_in(asked.products, session::kProducts);
  refuse_options_without_product(asked, products);
  const core::ThreadLimit threads(asked.threads);
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(asked, problems);
  RenderOptions options = asked;
  static_cast<session::SamplingRequest&>(options) = session::with_accuracy_of(description, asked);
  std::optional<bool> sample;
  if (!options.realisation.empty()) sample = options.realisation == "sample";
  session::Session session(
      description,
      {.build = build_options(options, products), .sample = sample, .seed = options.seed},
      problems);
  const std::shared_ptr<const scenes::Scene> scene = session.scene();
  if (!common.quiet) print_problems(problems.all());
  if (scene->trajectory && scene->trajectory->attitude_derived)
    spdlog::info("the trajectory has no full attitude: missing angles are derived from its path");
  const StopOnSignals stop_on_signals;
  try {
    std::optional<Progress> bar;
    const auto progress = frames_progress(bar, scene->description.name, common.quiet);
    const session::Sequence sequence =
        session::render_sequence(session, sequence_of(options, products), progress);
    bar.reset();
    if (!common.quiet) print_render_summary(sequence, *scene, options.accuracy_grey);
  } catch (const core::Stopped&) {
    if (!common.quiet)
      fmt::print(stderr, "stopped: frames on disk are whole, --resume goes on from there\n");
    return end_by_stop_signal();
  }
  return kExitDone;
}

void add_render(CommandLine& line) { line.add(declare_render, render); }

}  // namespace fanbeam::apps
