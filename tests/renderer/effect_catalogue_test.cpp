// The catalogue against the names of effects, and sets of them.
#include "renderer/plan/effect_catalogue.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <vector>

#include "core/effect_plan.h"
#include "renderer/plan/effect_texts.h"
#include "renderer/plan/plan.h"
#include "tests/comma_locale.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

TEST_CASE("Every effect has one row of the catalogue, in the order of their names", "[effects]") {
  std::vector<core::EffectId> rows;
  for (const auto touched : {renderer::Touches::pictures, renderer::Touches::samples})
    for (const renderer::Effect& effect : renderer::effect_catalogue(touched))
      rows.push_back(effect.id);
  REQUIRE(rows.size() == core::kEffectNames.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i] == static_cast<core::EffectId>(i));
    CHECK(name_of(rows[i]) == core::kEffectNames[i]);
  }
  CHECK(std::set(core::kEffectNames.begin(), core::kEffectNames.end()).size() == rows.size());
}

TEST_CASE("F18 figures in the texts of a plan have a point under a decimal comma", "[effects]") {
  const tests::CommaLocale comma;
  if (!comma.made()) return;
  const tests::HeldCommaLocale held(comma);
  CHECK(renderer::figure_text(7.5) == "7.5");
  CHECK(renderer::figure_text(0.0312) == "0.031");
  CHECK(renderer::figure_text(1234.5) == "1234");
}

TEST_CASE("A wish names every effect by its word, and no other", "[effects]") {
  for (std::size_t i = 0; i < core::kEffectNames.size(); ++i) {
    const auto effect = static_cast<core::EffectId>(i);
    const renderer::EffectWishes wishes = renderer::parse_effect_wishes(
        "+" + std::string(name_of(effect)), renderer::Touches::samples);
    core::EffectSet alone;
    alone.insert(effect);
    CHECK(wishes.forced_on == alone);
    CHECK(wishes.forced_on.names() == std::vector{name_of(effect)});
    CHECK(wishes.forced_off == core::EffectSet{});
  }
  for (const char* refused : {"+", "-", "gas", "+gass", "", "+ga", "*gas"})
    CHECK_THROWS_AS(renderer::parse_effect_wishes(refused), core::InputError);
}

TEST_CASE("An antenna sees heights as far from its aircraft's as lever and tilted level take it",
          "[effects]") {
  const auto& catalogue = renderer::effect_catalogue();
  const auto fog = std::find_if(catalogue.begin(), catalogue.end(), [](const auto& effect) {
    return effect.id == core::EffectId::fog;
  });
  REQUIRE(fog != catalogue.end());
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.highest_m = 60.0;
  atmosphere::FogLayer layer;
  layer.liquid_water_g_per_m3 = 0.5;
  layer.base_m = 460.0;
  layer.top_m = 760.0;
  facts.weather.fog_layers = {layer};
  CHECK(fog->bound_dB(facts) == 0.0);
  renderer::SceneFacts tilted = facts, mast = facts;
  tilted.vertical_turn_rad = 0.2;  // 740 m over 3.7 km
  CHECK(fog->bound_dB(tilted) > 0.1);
  mast.sensor.mounting.down_m = -800.0;
  CHECK(fog->bound_dB(mast) > 0.1);
  // Hung below, where the ground ends.
  renderer::SceneFacts hung = mast;
  hung.sensor.mounting.down_m = 800.0;
  hung.lowest_m = hung.highest_m = 1500.0;
  CHECK(fog->bound_dB(hung) > 0.1);
  hung.leaves_ground = false;
  CHECK(fog->bound_dB(hung) == 0.0);
}
