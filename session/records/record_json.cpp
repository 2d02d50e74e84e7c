#include "session/records/record_json.h"

#include <nlohmann/json.hpp>

#include "core/units.h"

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

std::string pose_json(const core::Pose& pose) {
  const core::Attitude attitude = core::attitude_from(pose.q_NB);
  const Json json = {{"latitude_deg", core::degrees(pose.position.latitude_rad)},
                     {"longitude_deg", core::degrees(pose.position.longitude_rad)},
                     {"height_m", pose.position.height_m},
                     {"roll_deg", core::degrees(attitude.roll_rad)},
                     {"pitch_deg", core::degrees(attitude.pitch_rad)},
                     {"heading_deg", core::degrees(attitude.heading_rad)}};
  return json.dump();
}

}  // namespace fanbeam::session
