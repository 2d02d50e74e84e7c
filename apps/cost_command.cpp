// fanbeam cost: what accuracy and effects cost in time on a scene, measured.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/cost_levels.h"
#include "apps/option_kinds.h"
#include "apps/progress.h"
#include "apps/scene_choice.h"
#include "core/files.h"
#include "core/parallel.h"
#include "measure/clock.h"
#include "measure/cost/cost.h"
#include "session/frame_choice.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

struct CostOptions : SceneChoice {
  std::string output;  // default out/<scene name>-cost
  std::string frames;  // as RenderOptions::frames; empty: two, spread over the trajectory
  std::vector<std::string> parts = {"ladder", "effects", "numerics", "levels"};
  std::string caster;   // of the effects' frames; empty: the scene's
  int repetitions = 0;  // 0: 20, or 3 with `quick`
  int threads = 0;
  bool quick = false;
};

CLI::App& declare_cost(CLI::App& program, CostOptions& options) {
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
  add_word(command, "--parts", options.parts, {"ladder", "effects", "numerics", "levels"},
           "What to measure: ladder (error against time of every way of sampling), effects "
           "(each left out or forced on), numerics (range in float or double, robust flag, "
           "sub-columns of the beam), levels (the B-scope from powers and from beat signals)")
      ->delimiter(',')
      ->capture_default_str();
  add_whole_number(command, "--repetitions", options.repetitions, {1, 10000},
                   "Repetitions of every timing after a warm-up (default 20, or 3 with --quick)");
  command.add_flag("--quick", options.quick,
                   "A short look: fewer steps and repetitions, a coarse reference");
  add_caster_option(command, options.caster,
                    "Way to sample the frames in which effects are measured (default: the scene's, "
                    "else auto)");
  add_threads_option(command, options.threads);
  return command;
}

// One of each half, so that neither is the first or the last.
std::vector<int> frames_of(const CostOptions& options, int count) {
  const std::vector<int> frames = session::parse_frames(options.frames, count);
  return options.frames.empty() ? session::spread_over(frames, count < 4 ? 1 : 2) : frames;
}

bool asks(const CostOptions& options, const char* part) {
  return std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
}

// Announces how long it will take, and measures. The signal level is no part of measure's, which knows no
// signals.
measure::CostFigures run(const measure::CostBench& quiet_bench, const CostOptions& options,
                         const CommonOptions& common, int threads) {
  const measure::CostParts parts{asks(options, "ladder"), asks(options, "effects"),
                                 asks(options, "numerics")};
  const std::string why_no_levels_there =
      asks(options, "levels") ? why_no_levels(quiet_bench) : std::string();
  const bool levels = asks(options, "levels") && why_no_levels_there.empty();
  const double total_s =
      expected_cost_s(quiet_bench, parts) + (levels ? levels_s(quiet_bench) : 0.0);
  const std::string& name = quiet_bench.scene.description.name;
  const std::size_t frames = quiet_bench.frames.size();
  if (!common.quiet)
    fmt::print("{}: {} {}, about {} in all\n", name, frames, frames == 1 ? "frame" : "frames",
               duration_text(total_s));
  CostProgress progress(name, total_s, common.quiet);
  measure::CostBench bench = quiet_bench;
  bench.progress = [&](const std::string& step, double expected_s) {
    progress.begin(step, expected_s);
  };
  measure::CostFigures figures = measure_cost(bench, parts, threads);
  figures.why_no_levels = why_no_levels_there;
  if (levels) figures.levels = measure_levels(bench);
  return figures;
}

measure::Effort effort_of(const CostOptions& options) {
  measure::Effort effort = options.quick ? measure::quick_effort() : measure::full_effort();
  if (options.repetitions > 0) effort.repetitions = options.repetitions;
  return effort;
}

// Writes ladder.csv, equal_error.csv, effects.csv, numerics.csv, levels.csv, plots as SVG and PNG, and cost.md.
int cost(const CostOptions& options, const CommonOptions& common) {
  const core::ThreadLimit threads(options.threads);
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(options, problems);
  scenes::BuildOptions build;
  // Slices are refused where there are none.
  if (!options.caster.empty()) build.caster = renderer::caster_wish(options.caster);
  std::shared_ptr<const scenes::Scene> scene =
      session::Session(description, {.build = build}, problems).scene();
  if (!common.quiet) print_problems(problems.all());
  const std::vector<int> frames = frames_of(options, scene->frame_count());
  const fs::path folder = options.output.empty()
                              ? core::default_output_folder(description.name, "-cost")
                              : fs::path(options.output);
  fs::create_directories(folder);  // before minutes are spent

  const measure::Clock::time_point begin = measure::Clock::now();
  const bool slices = scene->caster.why_no_slices.empty();
  const auto rebuild = [&](const scenes::BuildOptions& other) {
    core::ProblemList known;
    return session::Session(description, {.build = other}, known).scene();
  };
  const auto with_sensor = [&](const sensors::Sensor& sensor) {
    core::ProblemList known;
    scenes::SceneDescription other = description;
    other.sensor = sensor;
    scenes::BuildOptions rays;
    rays.caster = renderer::CasterWish::rays;
    return session::Session(other, {.build = rays}, known).scene();
  };
  const measure::CostBench bench{*scene,
                                 rebuild,
                                 with_sensor,
                                 build,
                                 effort_of(options),
                                 measure::measure_pace(*scene, frames.front(), slices),
                                 slices,
                                 renderer::default_sampling(scene->caster.chosen),
                                 frames};
  write_cost(run(bench, options, common, core::ThreadLimit::threads()), folder);
  if (common.quiet) return kExitDone;
  fmt::print("measured in {}{}\n{}\n", duration_text(measure::milliseconds_since(begin) * 1e-3),
             options.quick ? " (a quick look: its figures are no measurement)" : "",
             full_path(folder / "cost.md"));
  return kExitDone;
}

}  // namespace

void add_cost(CommandLine& line) { line.add(declare_cost, cost); }

}  // namespace fanbeam::apps
