#include "apps/cost_command.h"

#include <fmt/core.h>

#include <algorithm>

#include "apps/cost_levels.h"
#include "apps/progress.h"
#include "apps/render_command.h"
#include "core/files.h"
#include "core/parallel.h"
#include "measure/clock.h"
#include "measure/cost/cost.h"
#include "session/frame_choice.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

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
             fs::absolute(folder / "cost.md").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
