#include <nlohmann/json.hpp>

#include "core/machine.h"
#include "measure/plan_report.h"
#include "renderer/plan/effect_catalogue.h"
#include "session/records/record_json.h"
#include "session/records/run_record.h"
#include "session/version.h"

namespace fanbeam::measure {
namespace {

using Json = nlohmann::ordered_json;

Json plan_rows(const PlanReport& report) {
  Json rows = Json::parse(session::decisions_json(report.scene.plan));
  const auto& decisions = report.scene.plan.decisions;
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    Json& row = rows[i];
    row["bound_dB"] = decisions[i].bound_dB;
    for (const renderer::Effect& effect : renderer::effect_catalogue())
      if (effect.id == decisions[i].effect) {
        row["what"] = effect.what;
        row["source"] = renderer::source_in(effect, report.scene.weather);
      }
    if (report.measured && report.measured->costs[i]) {
      row["cost_ms"] = report.measured->costs[i]->ms;
      row["cost_error_ms"] = report.measured->costs[i]->error_ms;
    }
  }
  return rows;
}

Json spans_json(const PlanReport& report) {
  Json spans = Json::array();
  for (const PlanSpan& span : report.spans) {
    Json off = Json::array(), rows = Json::parse(session::decisions_json(span.plan));
    for (std::size_t i = 0; i < span.plan.decisions.size(); ++i)
      if (span.plan.decisions[i].on != report.scene.plan.decisions[i].on)
        off.push_back(std::move(rows[i]));
    spans.push_back(
        {{"first_frame", span.first}, {"last_frame", span.last}, {"left_out", std::move(off)}});
  }
  return spans;
}

}  // namespace

std::string plan_json(const PlanReport& report) {
  const scenes::Scene& scene = report.scene;
  const PlanBudget budget = budget_of(scene);
  Json json;
  json["version"] = session::version_text();
  json["commit"] = session::commit_text();
  json["scene"] = scene.description.name;
  json["title"] = scene.description.title;
  json["sensor"] = scene.description.sensor.name;
  json["accuracy"] = {{"grey", scene.accuracy_grey},
                      {"for_effects_grey", budget.for_effects},
                      {"left_out_grey", budget.left_out},
                      {"left_out_by_user_grey", budget.left_out_by_user},
                      {"for_sampling_grey", budget.for_sampling}};
  json["caster"] = {{"chosen", renderer::name_of(scene.caster.chosen)},
                    {"wish", renderer::name_of(scene.caster.wish)},
                    {"reason", scene.caster.reason}};
  json["frame_count"] = scene.frame_count();
  json["planning_ms"] = 1000.0 * scene.plan_s;
  json["scene_build_s"] = scene.build_s;
  json["plan"] = plan_rows(report);
  if (report.measured)
    json["measured"] = {{"frames", report.measured->run.frames},
                        {"repetitions", report.measured->run.repetitions},
                        {"frame_ms", report.measured->frame_ms},
                        {"sampling", session::caster_text(report.measured->run.sampling)},
                        {"threads", report.measured->threads},
                        {"isa", core::name_of(core::instruction_level())},
                        {"machine", core::processor_name()}};
  if (!report.spans.empty()) {
    json["per_frame"] = spans_json(report);
    json["frame_planning_ms"] = report.frame_plan_ms;
  }
  return json.dump(1) + "\n";
}

}  // namespace fanbeam::measure
