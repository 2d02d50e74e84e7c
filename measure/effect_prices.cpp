#include "measure/effect_prices.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/turns.h"
#include "measure/effect_cost.h"
#include "measure/frame_clock.h"

namespace fanbeam::measure {
namespace {

constexpr std::uint64_t kDrawnSeed = 1;  // of what is drawn, the same with and without an effect

std::string_view what_of(core::EffectId id) {
  for (const renderer::Effect& effect : renderer::effect_catalogue())
    if (effect.id == id) return effect.what;
  return {};
}

EffectPrice price_in_frame(const CostBench& bench, const scenes::Scene& other, int frame,
                           const EffectPrice& effect) {
  const renderer::FramePose pose = bench.scene.frame_pose(frame);
  const FrameClock planned(bench.scene.world, pose, bench.sampling,
                           renderer::effects_of(bench.scene.plan, kDrawnSeed));
  const FrameClock changed(other.world, pose, bench.sampling,
                           renderer::effects_of(other.plan, kDrawnSeed));
  const renderer::Frame a = planned.render(), b = changed.render();
  const auto times = core::time_in_turns({[&] { planned.render(); }, [&] { changed.render(); }},
                                         bench.effort.repetitions);
  EffectPrice price = effect;
  price.frame = frame;
  price.with = times[effect.planned ? 0 : 1];
  price.without = times[effect.planned ? 1 : 0];
  price.bscope = change_of(a.bscope_grey, b.bscope_grey);
  price.cscope = change_of(a.cscope_grey, b.cscope_grey);
  return price;
}

double pair_s(const CostBench& bench) {
  const double frame_ms = bench.sampling.caster == renderer::CasterKind::profile
                              ? bench.pace.slices_ms
                              : bench.pace.frame_ms;
  return bench.pace.build_s + static_cast<double>(bench.frames.size()) * 2.0 *
                                  (bench.effort.repetitions + 6.0) * frame_ms / 1000.0;
}

}  // namespace

Change change_of(const std::vector<double>& a, const std::vector<double>& b) {
  Change change;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double grey = std::abs(a[i] - b[i]);
    change.largest_grey = std::max(change.largest_grey, grey);
    change.rms_grey += grey * grey / static_cast<double>(a.size());
  }
  change.rms_grey = std::sqrt(change.rms_grey);
  return change;
}

double effects_s(const CostBench& bench) {
  // As a rule half of the effects can occur in a scene.
  return pair_s(bench) * static_cast<double>(bench.scene.plan.decisions.size()) / 2.0;
}

std::vector<EffectPrice> measure_effects(const CostBench& bench) {
  std::vector<EffectPrice> prices;
  for (std::size_t i = 0; i < bench.scene.plan.decisions.size(); ++i) {
    const core::EffectDecision& decision = bench.scene.plan.decisions[i];
    EffectPrice effect;
    effect.effect = name_of(decision.effect);
    effect.what = what_of(decision.effect);
    effect.reason = decision.reason;
    effect.planned = decision.on;
    effect.bound_grey = decision.bound_grey;
    effect.bound_dB = decision.bound_dB;
    effect.frame = bench.frames.front();
    scenes::BuildOptions build = bench.build;
    build.wishes = all_but(bench.scene.plan, decision.effect);
    // Planning costs nothing: whether the effect can occur is known before its scene is built. What
    // only a wish makes possible, as speckle, has its bound there.
    const core::EffectPlan other_plan =
        renderer::plan(bench.scene.facts, bench.scene.accuracy_grey, build.wishes);
    const core::EffectDecision& other_decision = other_plan.decisions[i];
    effect.possible = other_decision.on != decision.on;
    effect.bound_grey = std::max(effect.bound_grey, other_decision.bound_grey);
    effect.bound_dB = std::max(effect.bound_dB, other_decision.bound_dB);
    if (!effect.possible) {
      prices.push_back(effect);
      continue;
    }
    bench.begin(
        fmt::format("{} {}", name_of(decision.effect), decision.on ? "left out" : "forced on"),
        pair_s(bench));
    std::shared_ptr<const scenes::Scene> other = bench.rebuild(build);
    for (const int frame : bench.frames)
      prices.push_back(price_in_frame(bench, *other, frame, effect));
  }
  return prices;
}

std::vector<EffectPrice> over_frames(const std::vector<EffectPrice>& prices) {
  std::vector<EffectPrice> result;
  for (std::size_t i = 0; i < prices.size();) {
    std::size_t end = i + 1;
    while (end < prices.size() && prices[end].effect == prices[i].effect) ++end;
    const auto count = static_cast<double>(end - i);
    EffectPrice mean = prices[i];
    mean.with = mean.without = {};
    mean.bscope = mean.cscope = {};
    for (std::size_t k = i; k < end; ++k) {
      const auto add_time = [&](const core::MedianTime& from, core::MedianTime& to) {
        to.ms += from.ms / count;
        to.error_ms = std::hypot(to.error_ms, from.error_ms / count);
        to.repetitions += from.repetitions;
      };
      const auto add_change = [&](const Change& from, Change& to) {
        to.largest_grey = std::max(to.largest_grey, from.largest_grey);
        to.rms_grey = std::hypot(to.rms_grey, from.rms_grey / std::sqrt(count));
      };
      add_time(prices[k].with, mean.with);
      add_time(prices[k].without, mean.without);
      add_change(prices[k].bscope, mean.bscope);
      add_change(prices[k].cscope, mean.cscope);
    }
    result.push_back(mean);
    i = end;
  }
  return result;
}

}  // namespace fanbeam::measure
