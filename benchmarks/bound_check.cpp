#include "benchmarks/bound_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/bench_scene.h"
#include "benchmarks/reasons.h"
#include "benchmarks/view_clock.h"
#include "measure/effect_cost.h"
#include "measure/effect_prices.h"
#include "renderer/plan/plan.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::benchmarks {
namespace {

constexpr Target kApart_dB{10.0, 10.0};

double change_of_power(double level_dB) { return std::pow(10.0, level_dB / 10.0) - 1.0; }

// With the random numbers of one seed: what differs is the effect.
renderer::Frame frame_of(const scenes::Scene& scene, int frame) {
  const renderer::CasterKind caster = scene.caster.chosen;
  return FrameClock(scene.world, scene.frame_pose(frame), renderer::default_sampling(caster),
                    renderer::effects_of(scene.plan, 1))
      .render();
}

double influence_grey(const scenes::Scene& scene, core::EffectId effect, int most_frames) {
  core::ProblemList known;
  const auto without =
      scenes::under_conditions(scene, {.wishes = measure::all_but(scene.plan, effect)}, known);
  double largest = 0.0;
  for (const int frame : spread_frames(scene, most_frames)) {
    const renderer::Frame a = frame_of(scene, frame), b = frame_of(*without, frame);
    largest = std::max({largest, measure::change_of(a.bscope_grey, b.bscope_grey).largest_grey,
                        measure::change_of(a.cscope_grey, b.cscope_grey).largest_grey});
  }
  return largest;
}

}  // namespace

double BoundCase::apart_dB() const {
  const double least_dB = std::max(influence_grey, share_grey) * dB_per_grey;
  return 10.0 * std::log10(change_of_power(bound_dB) / change_of_power(least_dB));
}

std::vector<BoundCase> check_bounds(const Effort& effort) {
  std::vector<BoundCase> cases;
  for (const std::string& name : shipped_scenes()) {
    const auto bench = load(name);
    if (!bench) continue;
    const scenes::Scene& scene = *bench->scene;
    const double dB_per_grey = sensors::GreyScale(scene.world.sensor).dB_per_grey();
    for (const core::EffectDecision& decision : scene.plan.decisions) {
      if (!decision.on) continue;
      cases.push_back({name, std::string(name_of(decision.effect)), decision.bound_grey,
                       decision.bound_dB,
                       influence_grey(scene, decision.effect, effort.bound_frames),
                       renderer::effects_share_grey(scene.accuracy_grey), dB_per_grey});
    }
  }
  return cases;
}

std::string bounds_markdown(const std::vector<BoundCase>& cases) {
  if (cases.empty()) return "";
  std::string text =
      "## Effects that run, and what they change\n\n"
      "The largest change of any pixel of B-scope and C-scope when the effect is left out and all "
      "else\n"
      "stays, beside the bound for which it runs. Bound over influence, both as changes of power, "
      "where\n"
      "the influence is below the effect's share of the accuracy, which then stands for it.\n\n"
      "| scene | effect | bound, grey | influence, grey | share, grey | bound over influence |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (const BoundCase& each : cases)
    text += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {} |\n", each.scene, each.effect,
                        each.bound_grey, each.influence_grey, each.share_grey,
                        each.shows() ? "-" : fmt::format("{:.1f} dB", each.apart_dB()));
  return text + "\n";
}

TargetRow bounds_row(const std::vector<BoundCase>& cases) {
  TargetRow row(
      "all scenes, effects that run and change less than their share, bound over influence, dB",
      kNotKnown, fmt::format("{:.0f}", kApart_dB.must));
  const auto unseen = std::ranges::count_if(cases, [](const auto& each) { return !each.shows(); });
  row.add(fmt::format("{} of {} effects", unseen, cases.size()));
  for (const BoundCase& each : cases) {
    if (each.shows()) continue;
    row.add(fmt::format("{:.1f} {} in {}", each.apart_dB(), each.effect, each.scene));
    row.judge(each.apart_dB(), kApart_dB);
  }
  return row;
}

}  // namespace fanbeam::benchmarks
