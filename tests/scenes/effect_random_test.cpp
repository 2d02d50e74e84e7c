// What the plan leaves out of scenes drawn at random cannot be seen.
#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "tests/scenes/effect_draws.h"

namespace fanbeam::tests {

TEST_CASE("200 random scenes: the planned picture is that with everything on to a grey level",
          "[effects][random]") {
  std::map<std::string, int> left_out;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    EffectScene scene;
    draw_scene(seed, scene);
    const double accuracy_grey = Draws(seed + 1000).chance(0.5) ? 0.5 : 2.0;
    INFO("seed " << seed << ", accuracy " << accuracy_grey);
    try {
      built(scene, "");
    } catch (const core::InputError& e) {
      std::printf("seed %d: %s\n", (int)seed, e.what());
      continue;
    }
    const Shown planned = shown(scene, "", accuracy_grey);
    INFO(plan_text(planned.plan));
    const Shown all = shown(scene, "all", accuracy_grey);
    const double change_grey = largest_difference_grey(planned.frame, all.frame);
    double sum_grey = 0.0;
    for (const core::EffectDecision& each : planned.plan.decisions)
      if (!each.on) sum_grey += each.bound_grey;
    const bool moved =
        planned.plan.runs(renderer::kSideLobes) != all.plan.runs(renderer::kSideLobes) &&
        detail::lobes_move_rays(scene.sensor().antenna);
    if (change_grey > sum_grey)
      std::printf("seed %d: %g > %g moved %d\n", (int)seed, change_grey, sum_grey, (int)moved);
    CHECK(change_grey <= accuracy_grey / 2.0);
    for (const core::EffectDecision& each : planned.plan.decisions)
      if (!each.on && each.bound_grey > 0.0) ++left_out[each.effect];
  }
  // The draws do reach what they are meant for.
  for (const auto effect :
       {renderer::kGas, renderer::kFog, renderer::kRain, renderer::kSnow, renderer::kRainEcho,
        renderer::kSurfaceState, renderer::kSideLobes, renderer::kThermalNoise}) {
    INFO(effect);
    CHECK(left_out[std::string(effect)] >= 5);
  }
}

}  // namespace fanbeam::tests
