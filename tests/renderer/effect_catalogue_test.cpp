// The catalogue against the names of effects, and sets of them.
#include "renderer/plan/effect_catalogue.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/plan/effect_texts.h"
#include "renderer/plan/effects.h"
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
  for (const auto touched : {renderer::Touches::pictures, renderer::Touches::samples})
    for (const core::EffectId effect : renderer::effects_shown_in(touched)) {
      const renderer::EffectWishes wishes =
          renderer::parse_effect_wishes("+" + std::string(name_of(effect)), touched);
      CHECK(wishes.forced_on == core::EffectSet{effect});
      CHECK(wishes.forced_on.names() == std::vector{name_of(effect)});
      CHECK(wishes.forced_off == core::EffectSet{});
    }
  for (const char* refused : {"+", "-", "gas", "+gass", "", "+ga", "*gas"})
    CHECK_THROWS_AS(renderer::parse_effect_wishes(refused), core::InputError);
}

// One that a table of switches missed was planned on and ran nowhere.
TEST_CASE("What a plan runs is what its frames are made with, every effect of the catalogue",
          "[effects]") {
  core::EffectPlan all;
  core::EffectSet catalogue;
  for (const renderer::Effect& effect : renderer::effect_catalogue()) {
    INFO(effect.name());
    core::EffectPlan alone = all;
    for (core::EffectDecision& decision : alone.decisions) decision.on = false;
    alone.decisions.push_back({effect.id, true, ""});
    CHECK(renderer::effects_of(alone, 7) == renderer::Effects{{effect.id}, 7});
    all.decisions.push_back(alone.decisions.back());
    catalogue.insert(effect.id);
  }
  const renderer::Effects made = renderer::effects_of(all, 7);
  CHECK(made == renderer::Effects{catalogue, 7});
  const renderer::Effects expected = renderer::without_draws(made);
  for (const renderer::Effect& effect : renderer::effect_catalogue()) {
    INFO(effect.name());
    const bool drawn =
        effect.id == core::EffectId::speckle || effect.id == core::EffectId::swerling;
    CHECK(expected.runs(effect.id) != drawn);
  }
  CHECK(expected.seed == 7);
}

TEST_CASE("A set of effects gains and loses one, and sorts beside others", "[effects]") {
  using enum core::EffectId;
  core::EffectSet set{gas, speckle};
  set.erase(gas);
  set.erase(fog);  // it is not there
  CHECK(set == core::EffectSet{speckle});
  CHECK(set.with(gas, true) == core::EffectSet{speckle, gas});
  CHECK(set.with(speckle, false) == core::EffectSet{});
  CHECK(set.with(speckle, true) == set);
  // As keys of renderers: one differs by its set, or by its seed.
  const renderer::Effects one{{gas}, 1}, other{{fog}, 1}, reseeded{{gas}, 2};
  CHECK((one < other) != (other < one));
  CHECK((one < reseeded) != (reseeded < one));
}

// They were taken, and nothing came of them.
TEST_CASE("An effect that samples do not show cannot be forced on there, only off", "[effects]") {
  using enum core::EffectId;
  for (const core::EffectId effect :
       {rain_echo, double_bounce, range_response, thermal_noise, speckle}) {
    const std::string name(name_of(effect));
    INFO(name);
    try {
      renderer::parse_effect_wishes("-gas,+" + name, renderer::Touches::samples);
      FAIL("taken");
    } catch (const core::InputError& error) {
      REQUIRE(error.problems().size() == 1);
      CHECK(error.problems()[0].code == "E-UNSUPPORTED");
      CHECK(error.problems()[0].value == "\"+" + name + "\"");
      CHECK(error.problems()[0].expected.find(" +multipath") != std::string::npos);
      CHECK(error.problems()[0].expected.find(" +" + name) == std::string::npos);
    }
    CHECK_NOTHROW(renderer::parse_effect_wishes("+" + name));
    CHECK(renderer::parse_effect_wishes("-" + name, renderer::Touches::samples)
              .forced_off.contains(effect));
  }
}

// They named the default laws whatever the weather went by.
TEST_CASE("An effect's source is that of the laws that the weather goes by", "[effects]") {
  const auto source = [](core::EffectId id, const atmosphere::Weather& weather) {
    for (const renderer::Effect& effect : renderer::effect_catalogue())
      if (effect.id == id) return renderer::source_in(effect, weather);
    return std::string();
  };
  atmosphere::Weather weather;
  // None is there: as the catalogue has it.
  CHECK(source(core::EffectId::fog, weather) == "ITU-R P.840-8");
  CHECK(source(core::EffectId::rain, weather) == "ITU-R P.838-3");
  weather.liquid_water_g_per_m3 = 0.1;
  weather.rain_rate_mm_per_h = 5.0;
  CHECK(source(core::EffectId::fog, weather) == "Recommendation ITU-R P.840-8");
  CHECK(source(core::EffectId::rain, weather) == "Recommendation ITU-R P.838-3");
  weather.fog_law = atmosphere::FogLaw::altshuler;
  weather.rain_law = atmosphere::RainLaw::mie;
  weather.rain_echo_law = atmosphere::RainEchoLaw::georgia_tech_1975;
  CHECK(source(core::EffectId::fog, weather) == "Altshuler 1984, IEEE Trans. AP 32, 757");
  CHECK(source(core::EffectId::rain, weather).find("Mie scattering") == 0);
  CHECK(source(core::EffectId::rain_echo, weather) == "Georgia Tech 1975, measured (recalled)");
  // A layer by another law, and what melts.
  atmosphere::FogLayer cloud;
  cloud.liquid_water_g_per_m3 = 0.2;
  cloud.base_m = 300.0;
  cloud.top_m = 500.0;
  weather.fog_layers = {cloud, cloud};
  weather.melting_height_m = 2000.0;
  CHECK(source(core::EffectId::fog, weather) ==
        "Altshuler 1984, IEEE Trans. AP 32, 757; Recommendation ITU-R P.840-8");
  CHECK(source(core::EffectId::rain, weather).find("; Recommendation ITU-R P.530-17") !=
        std::string::npos);
  // What is no weather stays what it is.
  for (const renderer::Effect& effect : renderer::effect_catalogue())
    if (effect.id == core::EffectId::speckle)
      CHECK(renderer::source_in(effect, weather) == effect.source);
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

TEST_CASE("A corner's echo may cross a rain cell twice out and twice back", "[effects]") {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.sensor.range.cells = 1000;  // 6.7 km: a cell's longest chord, from 2 km below, is 2.1 km
  facts.weather.rain_cells = {{.radius_m = 104.0, .rain_rate_mm_per_h = 3.0, .top_m = 50.0}};
  const auto rain_dB = [&] {
    for (const core::EffectDecision& each : renderer::plan(facts, 0.5, {}).decisions)
      if (each.effect == core::EffectId::rain) return each.bound_dB;
    return 0.0;
  };
  const double direct_dB = rain_dB();
  CHECK(direct_dB > 0.0);
  facts.reflects = facts.mirrored_rays_end = true;
  CHECK(rain_dB() == Approx(2.0 * direct_dB).epsilon(1e-12));
  // Not farther than the path is long.
  facts.weather.rain_cells[0].radius_m = 50000.0;
  const double filled_dB = rain_dB();
  facts.reflects = false;
  CHECK(rain_dB() == filled_dB);
}
