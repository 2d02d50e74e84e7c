// What `fanbeam plan` has to tell: the decisions of a scene's plan, how the accuracy is shared, what frames
// can go without, and what effects cost.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/effect_cost.h"
#include "scenes/scene.h"

namespace fanbeam::measure {

// Consecutive frames of those looked at that go through the same stages.
struct PlanSpan {
  int first = 0, last = 0;
  core::EffectPlan plan;  // of the first
};

struct PlanCost {
  CostRun run;
  int threads = 0;
  double frame_ms = 0.0;
  std::vector<std::optional<EffectCost>> costs;  // by decision of the plan
};

struct PlanReport {
  const scenes::Scene& scene;
  std::optional<PlanCost> measured{};
  std::vector<PlanSpan> spans{};  // of frames that were planned one by one
  double frame_plan_ms = 0.0;     // mean time of planning one of these frames
};

// Plans each of these frames, at least one, into `report`.
void plan_frames(const std::vector<int>& frames, PlanReport& report);

// Over three of `frames`, sampled as fanbeam render does when nothing else is asked for, by as many threads as
// there are for them (core::ThreadLimit). `after_each` hears how many effects are done.
PlanCost measure_plan(const scenes::Scene& scene, const std::vector<int>& frames, int repetitions,
                      const std::function<void(int)>& after_each);

// How the accuracy is shared, in grey levels.
struct PlanBudget {
  double for_effects = 0.0;
  double left_out = 0.0;          // bounds that count against it
  double left_out_by_user = 0.0;  // beyond it
  double for_sampling = 0.0;
};
PlanBudget budget_of(const scenes::Scene& scene);

// docs/plan.md has its keys.
std::string plan_json(const PlanReport& report);

}  // namespace fanbeam::measure
