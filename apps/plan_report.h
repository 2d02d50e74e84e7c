// What `fanbeam plan` has to tell, and its two forms: a table of at most 100 columns, and JSON
// (docs/plan.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/effect_cost.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

// Consecutive frames of those looked at that go through the same stages.
struct PlanSpan {
  int first = 0, last = 0;
  core::EffectPlan plan;  // of the first
};

struct CostReport {
  measure::CostRun run;
  int threads = 0;
  double frame_ms = 0.0;
  std::vector<std::optional<measure::EffectCost>> costs;  // by decision of the plan
};

struct PlanReport {
  const scenes::Scene& scene;
  std::optional<CostReport> measured;
  std::vector<PlanSpan> spans;  // with --per-frame
  double frame_plan_ms = 0.0;   // mean time of planning one of these frames
};

// How the accuracy is shared, in grey levels.
struct Budget {
  double for_effects = 0.0;
  double left_out = 0.0;          // bounds that count against it
  double left_out_by_user = 0.0;  // beyond it
  double for_sampling = 0.0;
};
Budget budget_of(const scenes::Scene& scene);

// `notes`: with the lines that explain the columns.
std::string plan_table(const PlanReport& report, bool notes);
std::string plan_json(const PlanReport& report);

}  // namespace fanbeam::apps
