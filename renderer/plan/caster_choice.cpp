#include "renderer/plan/caster_choice.h"

#include <algorithm>
#include <cmath>

#include "renderer/casting/fan_layout.h"

namespace fanbeam::renderer {
namespace {

// What kLevelCosine of the casters allows.
const double kLevelWithin_rad = std::acos(kLevelCosine);

// Why azimuths are no vertical half-planes of the scene; empty when they are.
std::string why_not_level(const CasterFacts& facts) {
  if (!facts.plane_scan) return "the scan is a cone";
  if (!facts.stabilised) return "the antenna is not stabilised";
  if (!(facts.least_vertical_turn_rad < kLevelWithin_rad))
    return "all of the flight is outside the 6 km around the scene's origin in which the Earth is "
           "flat "
           "enough";
  return {};
}

std::string others_text(std::size_t others) {
  return others == 1 ? "the model or building part over open air"
                     : "the " + std::to_string(others) + " models or building parts over open air";
}

// Empty when slices can show the scene.
std::string why_no_slices(const CasterFacts& facts) {
  if (facts.fan_rad > kWidestSlices_rad)
    return "slices span at most 150 deg of azimuth, beam included";
  const std::string tilt = why_not_level(facts);
  if (facts.others == 0 || tilt.empty()) return {};
  return "slices cannot show " + others_text(facts.others) + " because " + tilt;
}

}  // namespace

CasterChoice choose_caster(CasterWish wish, const CasterFacts& facts, const core::Place& place) {
  CasterChoice choice;
  choice.wish = wish;
  choice.why_no_slices = why_no_slices(facts);
  const std::string& obstacle = choice.why_no_slices;
  if (wish == CasterWish::rays) {
    choice.reason = "asked for";
    return choice;
  }
  if (!obstacle.empty() && wish == CasterWish::profile)
    core::throw_input_error(core::ErrorClass::unsupported, place, "caster", "\"profile\"",
                            "\"rays\" or \"auto\": " + obstacle);
  if (!obstacle.empty()) {
    choice.reason = obstacle;
    return choice;
  }
  if (wish == CasterWish::automatic && facts.buildings == 0 && !facts.double_bounce) {
    choice.reason = facts.others == 0
                        ? "no building stands in the scene and no double bounce runs, "
                          "so that rays come as close in the same time"
                        : "what stands in the scene are shapes that slices leave to "
                          "rays, and no double bounce runs";
    return choice;
  }
  choice.chosen = CasterKind::profile;
  choice.others = facts.others;
  choice.reason = wish == CasterWish::profile ? "asked for"
                  : facts.buildings > 0
                      ? "over buildings slices come as close in half to all of the rays' time"
                      : "with double bounce slices come as close in half to all of the rays' time";
  if (facts.others > 0)
    choice.reason += "; azimuths with " + others_text(facts.others) + " in them go to rays";
  if (facts.others > 0 && !(facts.vertical_turn_rad < kLevelWithin_rad))
    choice.reason += ", and so do frames from beyond 6 km of the scene's origin";
  return choice;
}

CasterWish caster_wish(std::string_view word) {
  const auto found = std::find(kCasterWishes.begin(), kCasterWishes.end(), word);
  if (found == kCasterWishes.end())
    throw core::InternalError("no way to cast is called " + std::string(word));
  return static_cast<CasterWish>(found - kCasterWishes.begin());
}

std::string_view name_of(CasterWish wish) { return kCasterWishes[static_cast<std::size_t>(wish)]; }

std::string_view name_of(CasterKind caster) {
  return name_of(caster == CasterKind::profile ? CasterWish::profile : CasterWish::rays);
}

}  // namespace fanbeam::renderer
