#include "measure/plan_report.h"

#include "core/parallel.h"
#include "measure/clock.h"
#include "renderer/plan/plan.h"
#include "scenes/frame_plan.h"
#include "session/frame_choice.h"
#include "session/sampling_choice.h"

namespace fanbeam::measure {
namespace {

constexpr std::size_t kMeasuredFrames = 3;

bool same_stages(const core::EffectPlan& a, const core::EffectPlan& b) {
  for (std::size_t i = 0; i < a.decisions.size(); ++i)
    if (a.decisions[i].on != b.decisions[i].on) return false;
  return true;
}

renderer::Sampling chosen_sampling(const scenes::Scene& scene, const std::vector<int>& frames) {
  return session::choose_sampling(session::with_accuracy_of(scene.description, {}), scene, 0, {},
                                  session::poses_to_time(scene, frames))
      .sampling;
}

}  // namespace

void plan_frames(const std::vector<int>& frames, PlanReport& report) {
  const auto begin = Clock::now();
  for (const int frame : frames) {
    core::EffectPlan plan = scenes::frame_plan(report.scene, frame);
    if (report.spans.empty() || !same_stages(report.spans.back().plan, plan))
      report.spans.push_back({frame, frame, std::move(plan)});
    report.spans.back().last = frame;
  }
  report.frame_plan_ms = milliseconds_since(begin) / static_cast<double>(frames.size());
}

PlanCost measure_plan(const scenes::Scene& scene, const std::vector<int>& frames, int repetitions,
                      const std::function<void(int)>& after_each) {
  PlanCost cost{
      {session::spread_over(frames, kMeasuredFrames), repetitions, chosen_sampling(scene, frames)},
      core::ThreadLimit::threads(),
      0.0,
      {}};
  cost.frame_ms = frame_ms(scene, cost.run);
  cost.costs = effect_costs(scene, cost.run, after_each);
  return cost;
}

PlanBudget budget_of(const scenes::Scene& scene) {
  PlanBudget budget{renderer::effects_share_grey(scene.accuracy_grey), 0.0, 0.0,
                    renderer::sampling_share_grey(scene.accuracy_grey)};
  const renderer::EffectWishes& wishes = scene.options.wishes;
  for (const core::EffectDecision& decision : scene.plan.decisions) {
    if (decision.on) continue;
    const bool forced = wishes.base == renderer::EffectWishes::Base::none ||
                        wishes.forced_off.contains(decision.effect);
    (forced ? budget.left_out_by_user : budget.left_out) += decision.bound_grey;
  }
  return budget;
}

}  // namespace fanbeam::measure
