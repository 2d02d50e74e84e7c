#include "apps/plan_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "apps/text_table.h"
#include "renderer/plan/effect_catalogue.h"
#include "renderer/plan/effect_texts.h"
#include "session/records/run_record.h"

namespace fanbeam::apps {
namespace {

std::string labelled(std::string_view label, const std::string& text) {
  return beside(fmt::format("{:<12} ", label), text);
}

std::string frames_text(const measure::PlanSpan& span) {
  return span.first == span.last ? fmt::format("frame {}", span.first)
                                 : fmt::format("frames {} to {}", span.first, span.last);
}

bool impossible(const core::EffectDecision& decision) {
  if (decision.on || decision.bound_dB > 0.0) return false;
  const auto& catalogue = renderer::effect_catalogue();
  return std::any_of(catalogue.begin(), catalogue.end(), [&](const renderer::Effect& effect) {
    return effect.id == decision.effect && decision.reason == effect.why_impossible;
  });
}

std::string head(const measure::PlanReport& report) {
  const scenes::Scene& scene = report.scene;
  const sensors::Sensor& sensor = scene.description.sensor;
  const measure::PlanBudget budget = measure::budget_of(scene);
  std::string accuracy = fmt::format(
      "{} grey levels: {} for effects left out, of which {} taken; {} for sampling",
      core::number_text(scene.accuracy_grey), core::number_text(budget.for_effects),
      renderer::figure_text(budget.left_out) + (budget.left_out == 1.0 ? " is" : " are"),
      core::number_text(budget.for_sampling));
  if (budget.left_out_by_user > 0.0)
    accuracy += fmt::format("; beyond it up to {} that the user left out",
                            renderer::figure_text(std::min(budget.left_out_by_user, 255.0)));
  return labelled("scene", scene.description.name + ": " + scene.description.title) +
         labelled("sensor", fmt::format("{}, {:.4g} GHz, {} x {} cells, {:.3g} km", sensor.name,
                                        sensor.waveform.frequency_Hz / 1e9, sensor.scan.columns,
                                        sensor.range.cells, sensor.range.maximum_m() / 1000.0)) +
         labelled("accuracy", accuracy) +
         labelled("caster", fmt::format("{}: {}", renderer::name_of(scene.caster.chosen),
                                        scene.caster.reason)) +
         labelled("planned in", fmt::format("{:.1f} ms, of {:.1f} s for building the scene",
                                            1000.0 * scene.plan_s, scene.build_s));
}

std::string cost_text(const std::optional<measure::EffectCost>& cost) {
  return cost ? fmt::format("{:.2f} +-{:.2f}", cost->ms, cost->error_ms) : "-";
}

std::string rows(const measure::PlanReport& report) {
  const auto& decisions = report.scene.plan.decisions;
  std::size_t width = 6;
  for (const core::EffectDecision& decision : decisions)
    width = std::max(width, name_of(decision.effect).size());
  const auto row = [&](const std::string& effect, const std::string& on, const std::string& grey,
                       const std::string& dB, const std::string& ms, const std::string& why) {
    std::string lead = fmt::format("{:<{}}  {:<3}  {:>5}  {:>5}", effect, width, on, grey, dB);
    if (report.measured) lead += fmt::format("  {:>13}", ms);
    return beside(lead + "  ", why);
  };
  std::string table = row("effect", "run", "grey", "dB", "ms a frame", "why");
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    const core::EffectDecision& decision = decisions[i];
    const bool none = impossible(decision);
    const auto bound = [&](double value) {
      if (none) return std::string("-");
      return value > 0.0 && value < 0.001 ? "<.001" : renderer::figure_text(value);
    };
    table += row(std::string(name_of(decision.effect)), decision.on ? "on" : "off",
                 bound(std::min(decision.bound_grey, 255.0)), bound(decision.bound_dB),
                 report.measured ? cost_text(report.measured->costs[i]) : "", decision.reason);
  }
  return table;
}

std::string along_trajectory(const measure::PlanReport& report) {
  std::string text = fmt::format("frame by frame, {:.2f} ms to plan one:\n", report.frame_plan_ms);
  for (const measure::PlanSpan& span : report.spans) {
    std::string differs;
    for (std::size_t i = 0; i < span.plan.decisions.size(); ++i) {
      const core::EffectDecision& decision = span.plan.decisions[i];
      if (decision.on == report.scene.plan.decisions[i].on) continue;
      differs += fmt::format("{}{} off, {}", differs.empty() ? "" : "; ", name_of(decision.effect),
                             decision.reason);
    }
    text +=
        beside(fmt::format("  {}: ", frames_text(span)), differs.empty() ? "as above" : differs);
  }
  return text;
}

std::string notes_of(const measure::PlanReport& report) {
  std::string text = beside(
      "",
      "grey, dB: the most that leaving the effect out can change any pixel; 255 grey levels are "
      "the whole display. An effect is left out when its bound fits into what the budget leaves.");
  if (report.measured)
    text += beside("", fmt::format("ms: measured on {} frames of this scene, {} times each way, "
                                   "{} threads, {}; +- one standard deviation.",
                                   report.measured->run.frames.size(),
                                   report.measured->run.repetitions, report.measured->threads,
                                   session::caster_text(report.measured->run.sampling)));
  return text;
}

}  // namespace

std::string plan_table(const measure::PlanReport& report, bool notes) {
  std::string text = head(report);
  if (report.measured)
    text += labelled("frame takes", fmt::format("{:.1f} ms", report.measured->frame_ms));
  text += '\n' + rows(report);
  if (!report.spans.empty()) text += '\n' + along_trajectory(report);
  if (notes) text += '\n' + notes_of(report);
  return text;
}

}  // namespace fanbeam::apps
