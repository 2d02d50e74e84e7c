#include "apps/plan_command.h"

#include <fmt/core.h>

#include "apps/option_lists.h"
#include "apps/plan_report.h"
#include "core/parallel.h"
#include "measure/clock.h"
#include "scenes/frame_plan.h"
#include "session/frame_choice.h"
#include "session/sampling_choice.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

constexpr std::size_t kMeasuredFrames = 3;

bool same_stages(const core::EffectPlan& a, const core::EffectPlan& b) {
  for (std::size_t i = 0; i < a.decisions.size(); ++i)
    if (a.decisions[i].on != b.decisions[i].on) return false;
  return true;
}

void plan_frames(const std::vector<int>& frames, PlanReport& report) {
  const auto begin = measure::Clock::now();
  for (const int frame : frames) {
    core::EffectPlan plan = scenes::frame_plan(report.scene, frame);
    if (report.spans.empty() || !same_stages(report.spans.back().plan, plan))
      report.spans.push_back({frame, frame, std::move(plan)});
    report.spans.back().last = frame;
  }
  report.frame_plan_ms = measure::milliseconds_since(begin) / static_cast<double>(frames.size());
}

// As fanbeam render takes it when nothing else is asked for.
renderer::Sampling sampling_of(const scenes::Scene& scene, const std::vector<int>& frames) {
  return session::choose_sampling(session::with_accuracy_of(scene.description, {}), scene, 0, {},
                                  session::poses_to_time(scene, frames))
      .sampling;
}

CostReport measure(const scenes::Scene& scene, const std::vector<int>& frames, int repetitions,
                   int threads, bool quiet) {
  CostReport report{
      {session::spread_over(frames, kMeasuredFrames), repetitions, sampling_of(scene, frames)},
      threads,
      0.0,
      {}};
  report.frame_ms = measure::frame_ms(scene, report.run);
  report.costs = measure::effect_costs(scene, report.run, [&](int done) {
    if (!quiet)
      fmt::print(stderr, "measured {} of {} effects\n", done, scene.plan.decisions.size());
  });
  return report;
}

}  // namespace

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
  PlanReport report{*scene, {}, {}, 0.0};
  if (options.per_frame) plan_frames(frames, report);
  if (options.measure)
    report.measured = measure(*scene, frames, options.repetitions, threads.threads(), common.quiet);
  fmt::print("{}", options.json ? plan_json(report) : plan_table(report, !common.quiet));
  return kExitDone;
}

}  // namespace fanbeam::apps
