// What is to be rendered, in the words of a command line or of a suite (measure/regress/suite.h).
#pragma once

#include <cstdint>
#include <string>

#include "session/sampling_choice.h"

namespace fanbeam::session {

struct SceneChoice {
  std::string scene = "braunschweig-26";  // as find_scene takes it (shipped.h)
  std::string sensor{};                   // as find_sensor takes it; empty: the scene's
  std::string data{};                     // folder with terrain and flight data, looked at first
};

struct RenderRequest : SceneChoice, SamplingRequest {
  std::string frames{};  // as parse_frames takes it
  std::string products = "bscope,cscope";
  std::string effects{};      // as renderer::parse_effect_wishes takes them; empty: the scene's
  std::string realisation{};  // "mean" or "sample"; empty: the scene's
  std::string caster{};       // one of renderer::kCasterWishes; empty: the scene's
  std::uint64_t seed = 0;
};

}  // namespace fanbeam::session
