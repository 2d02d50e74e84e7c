#include "apps/decision_json.h"

namespace fanbeam::apps {

nlohmann::ordered_json decision_json(const core::EffectDecision& decision) {
  return {{"effect", decision.effect},
          {"on", decision.on},
          {"reason", decision.reason},
          {"bound_grey", decision.bound_grey}};
}

nlohmann::ordered_json decisions_json(const core::EffectPlan& plan) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const core::EffectDecision& decision : plan.decisions)
    rows.push_back(decision_json(decision));
  return rows;
}

}  // namespace fanbeam::apps
