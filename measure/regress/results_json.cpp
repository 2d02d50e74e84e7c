#include <nlohmann/json.hpp>

#include "measure/regress/report.h"
#include "session/records/record_json.h"
#include "session/version.h"

namespace fanbeam::measure {
namespace {

using Json = nlohmann::ordered_json;

Json figures_json(const LayerJudgement& layer) {
  Json json = {{"layer", layer.layer}, {"within", layer.within}};
  for (const Figure& figure : layer.figures) {
    Json entry = {{"value", figure.value}, {"unit", figure.unit}, {"within", figure.within}};
    if (figure.allowed) entry["allowed"] = *figure.allowed;
    json[figure.name] = std::move(entry);
  }
  json["largest_at"] = {{"column", layer.largest_column}, {"row", layer.largest_row}};
  return json;
}

Json picture_json(const PictureResult& picture) {
  Json json = {{"file", picture.file}, {"state", name_of(picture.state)}};
  if (!picture.note.empty()) json["note"] = picture.note;
  if (picture.tolerance) json["tolerance_reason"] = picture.tolerance->reason;
  if (picture.layers.empty()) return json;
  json["layers"] = Json::array();
  for (const LayerJudgement& layer : picture.layers) json["layers"].push_back(figures_json(layer));
  return json;
}

Json changes_json(const CaseResult& result) {
  Json json = Json::array();
  for (const SettingChange& change : changes_of(result))
    json.push_back({{"key", change.key}, {"approved", change.approved}, {"now", change.now}});
  return json;
}

Json case_json(const CaseResult& result) {
  Json json = {{"name", result.name}, {"folder", result.folder}, {"state", name_of(result.state)}};
  if (!result.now.isa.empty()) json["isa"] = result.now.isa;
  if (result.approval) {
    json["approved"] = {{"reason", result.approval->reason},
                        {"version", result.approval->version},
                        {"commit", result.approval->commit},
                        {"isa", result.approval->isa}};
    json["settings_changed"] = changes_json(result);
  }
  json["problems"] = Json::array();
  for (const core::Problem& problem : result.problems)
    json["problems"].push_back(core::to_string(problem));
  json["pictures"] = Json::array();
  for (const PictureResult& picture : result.pictures)
    json["pictures"].push_back(picture_json(picture));
  return json;
}

}  // namespace

std::string results_json(const Suite& suite, const std::vector<CaseResult>& results) {
  const Verdict verdict = verdict_of(results);
  Json json = {{"version", session::version_text()},
               {"commit", session::commit_text()},
               {"suite", suite.name},
               {"passed", verdict.passed},
               {"differs", verdict.differs},
               {"unapproved", verdict.unapproved},
               {"failed", verdict.failed},
               {"input", session::resolved_json<Json>(suite.resolved)},
               {"cases", Json::array()}};
  for (const CaseResult& result : results) json["cases"].push_back(case_json(result));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fanbeam::measure
