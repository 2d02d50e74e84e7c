#include "apps/cost_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "apps/cost/cost_csv.h"
#include "apps/cost/cost_markdown.h"
#include "apps/cost/cost_progress.h"
#include "apps/cost/levels.h"
#include "apps/cost/levels_report.h"
#include "apps/render_command.h"
#include "core/files.h"
#include "core/machine.h"
#include "core/parallel.h"
#include "core/turns.h"
#include "measure/bench.h"
#include "measure/clock.h"
#include "measure/cost_plots.h"
#include "measure/effect_prices.h"
#include "measure/frame_clock.h"
#include "measure/ladder.h"
#include "measure/numerics.h"
#include "sensors/display/grey_scale.h"
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

renderer::CasterKind effects_caster(const CostOptions& options, const scenes::Scene& scene) {
  const renderer::CasterWish wish =
      options.caster.empty() ? scene.description.caster : renderer::caster_wish(options.caster);
  return wish == renderer::CasterWish::rays ? renderer::CasterKind::rays : scene.caster.chosen;
}

double time_once_ms(const measure::FrameClock& work) {
  return core::time_in_turns({[&work] { work.render(); }}, 1).front().ms;
}

measure::Pace measure_pace(const scenes::Scene& scene, int frame, bool slices) {
  constexpr double kNaiveRays = 2.0;
  const renderer::FramePose pose = scene.frame_pose(frame);
  const renderer::Effects effects = measure::without_draws(renderer::effects_of(scene.plan, 0));
  measure::Pace pace;
  pace.build_s = scene.build_s;
  pace.frame_ms = time_once_ms(
      {scene.world, pose, renderer::default_sampling(renderer::CasterKind::rays), effects});
  if (slices)
    pace.slices_ms = time_once_ms(
        {scene.world, pose, renderer::default_sampling(renderer::CasterKind::profile), effects});
  pace.naive_ms = time_once_ms({scene.world,
                                pose,
                                renderer::NaiveKind::dithered,
                                kNaiveRays,
                                {scene.world.sensor.antenna.boresight_elevation_rad, 0.0},
                                effects}) /
                  kNaiveRays;
  return pace;
}

// Plots last: whoever lacks gnuplot has the figures.
void write(const measure::CostFigures& figures, const fs::path& folder) {
  core::write_file_atomically(folder / "cost.md", cost_markdown(figures));
  if (!figures.ladder.empty()) {
    core::write_file_atomically(folder / "ladder.csv", ladder_csv(figures));
    core::write_file_atomically(folder / "equal_error.csv", equal_error_csv(figures));
  }
  if (!figures.effects.empty())
    core::write_file_atomically(folder / "effects.csv", effects_csv(figures));
  if (!figures.numerics.variants.empty())
    core::write_file_atomically(folder / "numerics.csv", numerics_csv(figures));
  if (!figures.levels.empty())
    core::write_file_atomically(folder / "levels.csv", levels_csv(figures));
  if (!figures.ladder.empty()) {
    session::write_plots(measure::cost_ladder_plot(figures, false), folder / "ladder");
    session::write_plots(measure::cost_ladder_plot(figures, true), folder / "ladder-cscope");
  }
  if (!figures.effects.empty())
    session::write_plots(measure::effects_plot(figures), folder / "effects");
  if (!figures.levels.empty()) session::write_plots(levels_plot(figures), folder / "levels");
}

struct Parts {
  bool ladder, effects, numerics, levels;
};

Parts parts_of(const CostOptions& options) {
  const auto asked = [&](const char* part) {
    return std::find(options.parts.begin(), options.parts.end(), part) != options.parts.end();
  };
  return {asked("ladder"), asked("effects"), asked("numerics"), asked("levels")};
}

double expected_s(const measure::CostBench& bench, const Parts& parts) {
  const auto frames = static_cast<double>(bench.frames.size());
  double total_s = 0.0;
  if (parts.ladder || parts.numerics)
    total_s += frames * 2.0 * bench.pace.reference_s(bench.effort);
  if (parts.ladder) total_s += frames * bench.pace.ladder_s(bench.effort);
  if (parts.effects) total_s += measure::effects_s(bench);
  if (parts.numerics) total_s += measure::numerics_s(bench);
  if (parts.levels && why_no_levels(bench).empty()) total_s += levels_s(bench);
  return total_s;
}

void measure(const measure::CostBench& bench, const Parts& parts, measure::CostFigures& figures) {
  if (parts.ladder || parts.numerics) {
    const auto references = measure::render_references(bench, figures.references);
    if (parts.ladder) figures.ladder = measure::measure_ladder(bench, references);
    if (parts.numerics) figures.numerics = measure::measure_numerics(bench, references);
  }
  if (parts.effects) figures.effects = measure::measure_effects(bench);
  if (!parts.levels) return;
  figures.why_no_levels = why_no_levels(bench);
  if (figures.why_no_levels.empty()) figures.levels = measure_levels(bench);
}

measure::CostFigures head_of(const measure::CostBench& bench, const CostOptions& options,
                             int threads) {
  const scenes::Scene& scene = bench.scene;
  measure::CostFigures figures;
  figures.scene = scene.description.name;
  figures.title = scene.description.title;
  figures.machine = {core::processor_name(), core::name_of(core::instruction_level()), threads};
  figures.caster = renderer::name_of(bench.sampling.caster);
  if (!bench.slices) figures.why_no_slices = scene.caster.why_no_slices;
  figures.triangles = scene.world.surfaces().triangle_count();
  figures.dB_per_grey = sensors::GreyScale(scene.world.sensor).dB_per_grey();
  figures.accuracy_grey = scene.accuracy_grey;
  figures.quick = options.quick;
  figures.repetitions = bench.effort.repetitions;
  figures.frames = bench.frames;
  return figures;
}

// Announces how long it will take, and measures.
measure::CostFigures run(const measure::CostBench& quiet_bench, const CostOptions& options,
                         const CommonOptions& common, int threads) {
  const Parts parts = parts_of(options);
  const double total_s = expected_s(quiet_bench, parts);
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
  measure::CostFigures figures = head_of(bench, options, threads);
  measure(bench, parts, figures);
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
  if (options.caster == renderer::name_of(renderer::CasterWish::profile))
    build.caster = renderer::CasterWish::profile;  // refuses where there are none
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
                                 measure_pace(*scene, frames.front(), slices),
                                 slices,
                                 renderer::default_sampling(effects_caster(options, *scene)),
                                 frames};
  write(run(bench, options, common, threads.threads()), folder);
  if (common.quiet) return kExitDone;
  fmt::print("measured in {}{}\n{}\n", duration_text(measure::milliseconds_since(begin) * 1e-3),
             options.quick ? " (a quick look: its figures are no measurement)" : "",
             fs::absolute(folder / "cost.md").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
