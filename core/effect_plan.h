// Which effects run and why, as plain data that travels from the plan to every stage and into
// run.json.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

// Of every effect that there is, in the order in which plans list them; what each is and needs
// stands in renderer/plan/effect_catalogue.h.
enum class EffectId : std::uint8_t {
  gas,
  fog,
  rain,
  snow,
  rain_echo,
  double_bounce,
  multipath,
  surface_state,
  side_lobes,
  range_response,
  thermal_noise,
  speckle,
  swerling,
  receiver_noise,
  phase_noise,
  quantiser,
  interference,
  count,  // no effect: how many there are
};

inline constexpr std::array<std::string_view, 17> kEffectNames = {
    "gas",           "fog",         "rain",          "snow",           "rain-echo",
    "double-bounce", "multipath",   "surface-state", "side-lobes",     "range-response",
    "thermal-noise", "speckle",     "swerling",      "receiver-noise", "phase-noise",
    "quantiser",     "interference"};
static_assert(kEffectNames.size() == static_cast<std::size_t>(EffectId::count));

constexpr std::string_view name_of(EffectId effect) {
  return kEffectNames[static_cast<std::size_t>(effect)];
}
inline std::ostream& operator<<(std::ostream& stream, EffectId effect) {
  return stream << name_of(effect);
}

class EffectSet {
 public:
  constexpr EffectSet() = default;
  constexpr EffectSet(std::initializer_list<EffectId> effects) {
    for (const EffectId effect : effects) insert(effect);
  }
  constexpr bool contains(EffectId effect) const { return (bits_ & bit(effect)) != 0; }
  constexpr void insert(EffectId effect) { bits_ |= bit(effect); }
  constexpr void erase(EffectId effect) { bits_ &= ~bit(effect); }
  // These, and `effect` too or not, as told.
  constexpr EffectSet with(EffectId effect, bool contained) const {
    EffectSet result = *this;
    contained ? result.insert(effect) : result.erase(effect);
    return result;
  }
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> result;
    for (std::size_t i = 0; i < kEffectNames.size(); ++i)
      if (contains(static_cast<EffectId>(i))) result.push_back(kEffectNames[i]);
    return result;
  }
  auto operator<=>(const EffectSet&) const = default;

 private:
  static constexpr std::uint32_t bit(EffectId effect) {
    return std::uint32_t{1} << static_cast<unsigned>(effect);
  }
  std::uint32_t bits_ = 0;
};

struct EffectDecision {
  EffectId effect{};
  bool on = false;
  std::string reason;  // one sentence
  double bound_grey =
      0.0;  // largest change of any displayed pixel, in grey levels, that leaving it out can cause
  double bound_dB = 0.0;
};

struct EffectPlan {
  std::vector<EffectDecision> decisions;

  bool runs(EffectId effect) const {
    for (const EffectDecision& decision : decisions)
      if (decision.effect == effect) return decision.on;
    return false;
  }
};

}  // namespace fanbeam::core
