// What a file asked for, default values included, as every record writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <variant>

#include "core/config_table.h"

namespace fanbeam::apps {

inline nlohmann::ordered_json resolved_json(const core::ResolvedConfig& resolved) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [path, value] : resolved)
    std::visit([&, &key = path](const auto& v) { json[key] = v; }, value);
  return json;
}

}  // namespace fanbeam::apps
