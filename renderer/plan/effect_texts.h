// What an effect does in a scene, as the plan tells it: one clause with the figures that decide,
// read like "fog of 0.1 g/m3 takes up to 0.9 dB both ways over 3.7 km". plan.cpp puts the grey
// levels and the budget behind it.
//
// Each takes the scene's facts and the effect's bound in dB.
#pragma once

#include <string>

#include "renderer/plan/scene_facts.h"

namespace fanbeam::renderer {

// Two digits that matter, without an exponent: "0.031", "3.8", "255"; "under 0.001" below that.
std::string figure_text(double value);

std::string gas_cause(const SceneFacts& facts, double bound_dB);
std::string fog_cause(const SceneFacts& facts, double bound_dB);
std::string rain_cause(const SceneFacts& facts, double bound_dB);
std::string snow_cause(const SceneFacts& facts, double bound_dB);
std::string rain_echo_cause(const SceneFacts& facts, double bound_dB);
std::string double_bounce_cause(const SceneFacts& facts, double bound_dB);
std::string multipath_cause(const SceneFacts& facts, double bound_dB);
std::string surface_state_cause(const SceneFacts& facts, double bound_dB);
std::string side_lobe_cause(const SceneFacts& facts, double bound_dB);
std::string range_response_cause(const SceneFacts& facts, double bound_dB);
std::string noise_cause(const SceneFacts& facts, double bound_dB);
std::string speckle_cause(const SceneFacts& facts, double bound_dB);
std::string swerling_cause(const SceneFacts& facts, double bound_dB);

}  // namespace fanbeam::renderer
