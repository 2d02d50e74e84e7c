// What several records say in the same words, as JSON texts.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include "core/config_table.h"
#include "core/effect_plan.h"
#include "core/pose.h"

namespace fanbeam::session {

// An array of {effect, on, reason, bound_grey}, by decision.
std::string decisions_json(const core::EffectPlan& plan);

// An object of position and attitude, in degrees and metres.
std::string pose_json(const core::Pose& pose);

// An object of what a file asked for, default values included; the last value where a key is there twice.
// `Json` keeps its members in the order of a list, which it searches from the front: a scene of 10 000 targets
// has 100 000 keys, so none is looked up there.
template <typename Json>
Json resolved_json(const core::ResolvedConfig& resolved) {
  typename Json::object_t members;
  members.reserve(resolved.size());
  std::unordered_map<std::string_view, std::size_t> places;
  for (const auto& [path, value] : resolved) {
    Json told = std::visit([](const auto& v) { return Json(v); }, value);
    const auto [place, fresh] = places.emplace(path, members.size());
    if (fresh)
      members.push_back({path, std::move(told)});
    else
      (members.begin() + static_cast<std::ptrdiff_t>(place->second))->second = std::move(told);
  }
  return members;
}

}  // namespace fanbeam::session
