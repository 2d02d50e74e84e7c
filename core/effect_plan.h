// Which effects run and why, as plain data that travels from the plan to every stage and into
// run.json.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

struct EffectDecision {
  std::string effect;
  bool on = false;
  std::string reason;  // one sentence
  double bound_grey =
      0.0;  // largest change of any displayed pixel, in grey levels, that leaving it out can cause
  double bound_dB = 0.0;
};

struct EffectPlan {
  std::vector<EffectDecision> decisions;

  bool runs(std::string_view effect) const {
    for (const EffectDecision& decision : decisions)
      if (decision.effect == effect) return decision.on;
    return false;
  }
};

}  // namespace fanbeam::core
