#include "apps/plan_command.h"

#include <fmt/core.h>

#include "apps/option_lists.h"
#include "apps/plan_table.h"
#include "core/parallel.h"
#include "session/frame_choice.h"
#include "session/session.h"

namespace fanbeam::apps {

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

}  // namespace fanbeam::apps
