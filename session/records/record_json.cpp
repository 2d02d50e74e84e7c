#include "session/records/record_json.h"

#include <nlohmann/json.hpp>
#include <variant>

namespace fanbeam::session {

using Json = nlohmann::ordered_json;

std::string decisions_json(const core::EffectPlan& plan) {
  Json rows = Json::array();
  for (const core::EffectDecision& decision : plan.decisions)
    rows.push_back({{"effect", name_of(decision.effect)},
                    {"on", decision.on},
                    {"reason", decision.reason},
                    {"bound_grey", decision.bound_grey}});
  return rows.dump();
}

std::string resolved_json(const core::ResolvedConfig& resolved) {
  Json json = Json::object();
  for (const auto& [path, value] : resolved)
    std::visit([&, &key = path](const auto& v) { json[key] = v; }, value);
  return json.dump();
}

}  // namespace fanbeam::session
