// Effects left out together, in one realisation, and at the ends of the display.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "tests/scenes/effect_threshold.h"

namespace fanbeam::tests {

TEST_CASE("Losses left out together add up, and together stay within the budget", "[effects]") {
  EffectScene scene;
  scene.sensor().waveform.frequency_Hz = 12e9;  // little oxygen
  scene.weather().humidity = 0.0;
  scene.weather().temperature_C = -39.0;
  scene.weather().fog_top_m = scene.weather().snow_top_m = 3000.0;
  const Set fog = [](EffectScene& s, double x) { s.weather().liquid_water_g_per_m3 = x; };
  const auto set_to = [&](double grey, core::EffectId effect, const Set& set, double start) {
    set(scene, magnitude_at(grey, scene, effect, others_off(effect), set, start));
  };
  // Gas last: air in fog is saturated.
  set_to(0.06, core::EffectId::fog, fog, 0.01);
  set_to(
      0.06, core::EffectId::snow,
      [](EffectScene& s, double x) { s.weather().snow_rate_mm_per_h = x; }, 0.1);
  set_to(
      0.12, core::EffectId::gas, [](EffectScene& s, double x) { s.weather().pressure_hPa = x; },
      400.0);
  const std::string rest = "-thermal-noise,-rain-echo";
  const Shown planned = shown(scene, rest);
  for (const auto effect : {core::EffectId::gas, core::EffectId::fog, core::EffectId::snow})
    CHECK_FALSE(planned.plan.runs(effect));
  const Shown all = shown(scene, "all," + rest);
  const double change_grey = largest_difference_grey(planned.frame, all.frame);
  CHECK(change_grey <= kBudget_grey);
  CHECK(change_grey > 0.75 * 0.24);

  // A little more fog, and the largest of the three must run.
  set_to(0.08, core::EffectId::fog, fog, 0.01);
  const core::EffectPlan crowded = built(scene, rest)->plan;
  CHECK(crowded.runs(core::EffectId::gas));
  CHECK_FALSE(crowded.runs(core::EffectId::fog));
  CHECK_FALSE(crowded.runs(core::EffectId::snow));
}

TEST_CASE("In one realisation what is left out changes no draw", "[effects]") {
  EffectScene scene;
  scene.description.sample = true;
  const std::string wishes = "-gas,-rain";
  CHECK(change_under_threshold(
            scene, core::EffectId::rain_echo,
            [](EffectScene& s, double x) { s.weather().rain_rate_mm_per_h = x; }, 1e-6,
            wishes) > 0.0);
  scene.weather().rain_rate_mm_per_h = 0.0;
  // A loss multiplies speckled ground as it does the mean.
  CHECK(change_under_threshold(
            scene, core::EffectId::fog,
            [](EffectScene& s, double x) { s.weather().liquid_water_g_per_m3 = x; }, 0.01,
            "-gas,-thermal-noise") > 0.5 * kBudget_grey);
}

TEST_CASE("Beyond the ends of the display nothing changes, whatever is left out", "[effects]") {
  EffectScene scene;
  scene.weather().liquid_water_g_per_m3 = 0.05;
  scene.weather().rain_rate_mm_per_h = 0.1;
  for (const double low_dB : {-200.0, 100.0}) {
    scene.sensor().display.low_dB = low_dB;
    scene.sensor().display.high_dB = low_dB + 60.0;
    scene.sensor().range.cells = 100;
    const Shown none = shown(scene, "none");
    const Shown all = shown(scene, "all");
    const auto& grey = none.frame.bscope_grey;
    INFO(low_dB);
    CHECK(*std::max_element(grey.begin(), grey.end()) == (low_dB < 0.0 ? 255.0 : 0.0));
    for (std::size_t i = 0; i < grey.size(); ++i)
      if (grey[i] == 255.0 || low_dB > 0.0) REQUIRE(all.frame.bscope_grey[i] == grey[i]);
  }
}

}  // namespace fanbeam::tests
