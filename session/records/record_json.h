// What several records say in the same words, as JSON texts.
#pragma once

#include <string>

#include "core/config_table.h"
#include "core/effect_plan.h"
#include "core/pose.h"

namespace fanbeam::session {

// An array of {effect, on, reason, bound_grey}, by decision.
std::string decisions_json(const core::EffectPlan& plan);

// An object of position and attitude, in degrees and metres.
std::string pose_json(const core::Pose& pose);

// An object of what a file asked for, default values included.
std::string resolved_json(const core::ResolvedConfig& resolved);

}  // namespace fanbeam::session
