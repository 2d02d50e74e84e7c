// The catalogue against the names of effects, and sets of them.
#include "renderer/plan/effect_catalogue.h"

#include <catch2/catch.hpp>
#include <set>
#include <vector>

#include "core/effect_plan.h"
#include "renderer/plan/plan.h"

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
