// What the desk knows, as it is told: live/openapi.json describes it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "live/hub.h"
#include "live/truth.h"
#include "scenes/scene.h"

namespace fanbeam::live {

using Json = nlohmann::json;

Json errors_json(const std::optional<PictureErrors>& errors);
Json status_json(const Status& status);
// Prometheus' text format, version 0.0.4.
std::string metrics_text(const Status& status);
Json map_json(const scenes::Scene& scene);
Json plan_json(const scenes::Scene& scene);
Json sensor_json(const sensors::Sensor& sensor);
Json weather_json(const atmosphere::Weather& weather);
// As weather_json has it: of fog that is told by its water, what goes with that, as far as it goes with any.
std::optional<double> told_visibility_m(const atmosphere::Weather& weather);
Json truth_json(const CellTruth& cell);

}  // namespace fanbeam::live
