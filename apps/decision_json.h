// Decisions of an effect plan as every record writes them.
#pragma once

#include <nlohmann/json.hpp>

#include "core/effect_plan.h"

namespace fanbeam::apps {

nlohmann::ordered_json decision_json(const core::EffectDecision& decision);
nlohmann::ordered_json decisions_json(const core::EffectPlan& plan);

}  // namespace fanbeam::apps
