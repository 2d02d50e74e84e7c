// What the plan leaves out of scenes drawn at random cannot be seen.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "tests/scenes/effect_draws.h"

namespace fanbeam::tests {
namespace {

// Level ground along other rays (effect_draws.h) differs by this.
constexpr double kOtherRays_grey = 0.05;
// The echo of rain, worked out in finer steps where fog ends within the beam, seen or not, by this.
constexpr double kOtherSteps_grey = 0.01;

double left_out_grey(const core::EffectPlan& plan) {
  double sum = 0.0;
  for (const core::EffectDecision& each : plan.decisions)
    if (!each.on) sum += each.bound_grey;
  return sum;
}

}  // namespace

TEST_CASE("200 random scenes: the planned picture is that with everything on to a grey level",
          "[effects][random]") {
  std::map<core::EffectId, int> left_out;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    EffectScene scene;
    draw_scene(seed, scene);
    const double accuracy_grey = seed % 2 == 0 ? 0.5 : 2.0;
    INFO("seed " << seed << ", accuracy " << accuracy_grey);
    const Shown planned = shown(scene, "", accuracy_grey);
    INFO(plan_text(planned.plan));
    const Shown all = shown(scene, "all", accuracy_grey);
    const bool other_rays = planned.plan.runs(core::EffectId::side_lobes) !=
                                all.plan.runs(core::EffectId::side_lobes) &&
                            detail::lobes_move_rays(scene.sensor().antenna);
    const double change_grey = largest_difference_grey(planned.frame, all.frame);
    CHECK(left_out_grey(planned.plan) <= accuracy_grey / 2.0);
    CHECK(change_grey <= 1.0);
    const bool other_steps =
        all.plan.runs(core::EffectId::rain_echo) &&
        planned.plan.runs(core::EffectId::fog) != all.plan.runs(core::EffectId::fog);
    CHECK(change_grey <= left_out_grey(planned.plan) + (other_rays ? kOtherRays_grey : 0.0) +
                             (other_steps ? kOtherSteps_grey : 0.0) + 1e-9);
    for (const core::EffectDecision& each : planned.plan.decisions)
      if (!each.on && each.bound_grey > 0.0) ++left_out[each.effect];
  }
  // The draws do reach what they are meant for.
  for (const auto effect :
       {core::EffectId::gas, core::EffectId::fog, core::EffectId::rain, core::EffectId::snow,
        core::EffectId::rain_echo, core::EffectId::surface_state, core::EffectId::side_lobes,
        core::EffectId::thermal_noise}) {
    INFO(effect);
    CHECK(left_out[effect] >= 5);
  }
}

}  // namespace fanbeam::tests
