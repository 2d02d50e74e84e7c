#include "measure/effect_cost.h"

#include <algorithm>
#include <cmath>

#include "core/effect_plan.h"
#include "core/turns.h"
#include "measure/clock.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::measure {
namespace {

using renderer::FrameRenderer;

constexpr std::uint64_t kSeed = 0;
const renderer::Products kPictures{true, true};

double render_ms(const FrameRenderer& renderer, const renderer::FramePose& pose) {
  const Clock::time_point begin = Clock::now();
  renderer.render(pose);
  return milliseconds_since(begin);
}

EffectCost difference(const FrameRenderer& with, const FrameRenderer& without,
                      const scenes::Scene& scene, const CostRun& run) {
  EffectCost cost;
  double variance = 0.0;
  for (const int frame : run.frames) {
    const renderer::FramePose pose = scene.frame_pose(frame);
    for (int warm_up = 0; warm_up < 2; ++warm_up) {
      render_ms(with, pose);
      render_ms(without, pose);
    }
    std::vector<double> differences_ms;
    for (int i = 0; i < run.repetitions; ++i) {
      const bool with_first = i % 2 == 0;
      const double first_ms = render_ms(with_first ? with : without, pose);
      const double second_ms = render_ms(with_first ? without : with, pose);
      differences_ms.push_back(with_first ? first_ms - second_ms : second_ms - first_ms);
    }
    const core::MedianTime median = core::median_of(std::move(differences_ms));
    cost.ms += median.ms;
    variance += median.error_ms * median.error_ms;
  }
  const auto frames = static_cast<double>(run.frames.size());
  cost.ms /= frames;
  cost.error_ms = std::sqrt(variance) / frames;
  return cost;
}

EffectCost cost_of(const core::EffectDecision& decision, const scenes::Scene& scene,
                   const CostRun& run) {
  core::ProblemList known;
  const auto turned =
      scenes::under_conditions(scene, {.wishes = all_but(scene.plan, decision.effect)}, known);
  const FrameRenderer as_planned(scene.world, run.sampling, kPictures,
                                 renderer::effects_of(scene.plan, kSeed));
  const FrameRenderer other(turned->world, run.sampling, kPictures,
                            renderer::effects_of(turned->plan, kSeed));
  return decision.on ? difference(as_planned, other, scene, run)
                     : difference(other, as_planned, scene, run);
}

}  // namespace

renderer::EffectWishes all_but(const core::EffectPlan& plan, core::EffectId flipped) {
  renderer::EffectWishes wishes;
  wishes.base = renderer::EffectWishes::Base::none;
  for (const core::EffectDecision& decision : plan.decisions)
    if (decision.on != (decision.effect == flipped)) wishes.forced_on.insert(decision.effect);
  return wishes;
}

std::vector<std::optional<EffectCost>> effect_costs(const scenes::Scene& scene, const CostRun& run,
                                                    const std::function<void(int)>& after_each) {
  std::vector<std::optional<EffectCost>> costs;
  for (const core::EffectDecision& decision : scene.plan.decisions) {
    const core::EffectPlan turned =
        renderer::plan(scene.facts, scene.accuracy_grey, all_but(scene.plan, decision.effect));
    const bool possible = turned.runs(decision.effect) != decision.on;
    costs.push_back(possible ? std::optional(cost_of(decision, scene, run)) : std::nullopt);
    after_each(static_cast<int>(costs.size()));
  }
  return costs;
}

double frame_ms(const scenes::Scene& scene, const CostRun& run) {
  const FrameRenderer renderer(scene.world, run.sampling, kPictures,
                               renderer::effects_of(scene.plan, kSeed));
  std::vector<double> times_ms;
  for (const int frame : run.frames) {
    const renderer::FramePose pose = scene.frame_pose(frame);
    for (int i = -2; i < run.repetitions; ++i) {
      const double time_ms = render_ms(renderer, pose);
      if (i >= 0) times_ms.push_back(time_ms);
    }
  }
  return core::median_of(std::move(times_ms)).ms;
}

}  // namespace fanbeam::measure
