// Rays or slices, and why: every rule with the facts that decide it.
#include "renderer/plan/caster_choice.h"

#include <catch2/catch.hpp>

using namespace fanbeam;
using renderer::CasterFacts;
using renderer::CasterKind;
using renderer::CasterWish;
using renderer::choose_caster;

namespace {

// Facts with which an azimuth is no vertical half-plane of the scene, and how the reason says so.
struct Tilted {
  CasterFacts facts;
  std::string why;
};

std::vector<Tilted> tilted(std::size_t others) {
  return {{{.others = others, .stabilised = false}, "the antenna is not stabilised"},
          {{.others = others, .plane_scan = false}, "the scan is a cone"},
          {{.others = others, .least_vertical_turn_rad = 1.1e-3, .vertical_turn_rad = 2e-3},
           "outside the 6 km around"}};
}

void check_refused(const CasterFacts& facts, const std::string& why) {
  const auto automatic = choose_caster(CasterWish::automatic, facts);
  CHECK(automatic.chosen == CasterKind::rays);
  CHECK(automatic.wish == CasterWish::automatic);
  CHECK(automatic.others == 0);
  CHECK(automatic.reason.find(why) != std::string::npos);
  try {
    choose_caster(CasterWish::profile, facts, {.file = "scene.toml", .line = 7, .column = 3});
    FAIL("forced slices were taken");
  } catch (const core::InputError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(core::to_string(error.problems()[0]) ==
          "scene.toml:7:3: E-UNSUPPORTED caster = \"profile\": expected \"rays\" or \"auto\": " +
              automatic.reason);
  }
}

}  // namespace

TEST_CASE("Rays are taken when asked for, whatever the scene", "[caster_choice]") {
  std::vector<Tilted> scenes = tilted(3);
  scenes.push_back({{}, ""});
  for (const Tilted& scene : scenes) {
    const auto choice = choose_caster(CasterWish::rays, scene.facts);
    CHECK(choice.chosen == CasterKind::rays);
    CHECK(choice.reason == "asked for");
  }
}

TEST_CASE("Over open ground rays are taken, and slices where they are asked for",
          "[caster_choice]") {
  const auto automatic = choose_caster(CasterWish::automatic, {.buildings = 0});
  CHECK(automatic.chosen == CasterKind::rays);
  CHECK(automatic.reason ==
        "no building stands in the scene and no double bounce runs, so that rays come as close in "
        "the same time");
  CHECK(automatic.why_no_slices.empty());
  CHECK(choose_caster(CasterWish::automatic, {.buildings = 0, .others = 2}).chosen ==
        CasterKind::rays);
  CHECK(choose_caster(CasterWish::profile, {.buildings = 0}).chosen == CasterKind::profile);
}

// Of a lava field with mirrored rays in it 4 rays were left with 0.51 grey in 45 ms, 2 slices with 0.28 in 29.
TEST_CASE("Where double bounce runs slices are taken, buildings or not", "[caster_choice]") {
  const auto open = choose_caster(CasterWish::automatic, {.buildings = 0, .double_bounce = true});
  CHECK(open.chosen == CasterKind::profile);
  CHECK(open.reason == "with double bounce slices come as close in half to all of the rays' time");
  const auto models =
      choose_caster(CasterWish::automatic, {.buildings = 0, .others = 1, .double_bounce = true});
  CHECK(models.chosen == CasterKind::profile);
  CHECK(models.others == 1);
  check_refused({.buildings = 0, .double_bounce = true, .fan_rad = 2.7}, "at most 150 deg");
  CHECK(choose_caster(CasterWish::rays, {.buildings = 0, .double_bounce = true}).chosen ==
        CasterKind::rays);
}

TEST_CASE("Ground and solid prisms go to slices with any antenna", "[caster_choice]") {
  std::vector<Tilted> scenes = tilted(0);
  scenes.push_back({{}, ""});
  for (const Tilted& scene : scenes) {
    const auto automatic = choose_caster(CasterWish::automatic, scene.facts);
    CHECK(automatic.chosen == CasterKind::profile);
    CHECK(automatic.others == 0);
    CHECK(automatic.reason ==
          "over buildings slices come as close in half to all of the rays' time");
    const auto forced = choose_caster(CasterWish::profile, scene.facts);
    CHECK(forced.chosen == CasterKind::profile);
    CHECK(forced.reason == "asked for");
  }
}

TEST_CASE("With a level antenna slices leave the azimuths of models to rays", "[caster_choice]") {
  // Just below a tilt that counts.
  const CasterFacts facts{.others = 1, .vertical_turn_rad = 0.99e-3};
  const auto one = choose_caster(CasterWish::profile, facts);
  CHECK(one.chosen == CasterKind::profile);
  CHECK(one.others == 1);
  CHECK(one.reason ==
        "asked for; azimuths with the model or building part over open air in them go to rays");
  // Some of the flight too far away: those frames alone.
  const auto far =
      choose_caster(CasterWish::profile,
                    {.others = 1, .least_vertical_turn_rad = 0.0, .vertical_turn_rad = 1.1e-3});
  CHECK(far.chosen == CasterKind::profile);
  CHECK(far.reason == one.reason + ", and so do frames from beyond 6 km of the scene's origin");
  const auto many = choose_caster(CasterWish::automatic, {.others = 12});
  CHECK(many.chosen == CasterKind::profile);
  CHECK(many.others == 12);
  CHECK(many.reason.find("azimuths with the 12 models or building parts") != std::string::npos);
}

TEST_CASE("Where azimuths are no half-planes models leave everything to rays", "[caster_choice]") {
  for (const Tilted& scene : tilted(2)) check_refused(scene.facts, scene.why);
}

TEST_CASE("Words and wishes are each other's inverse", "[caster_choice]") {
  for (const CasterWish wish : {CasterWish::rays, CasterWish::profile, CasterWish::automatic})
    CHECK(renderer::caster_wish(renderer::name_of(wish)) == wish);
  CHECK(renderer::name_of(CasterWish::automatic) == "auto");
  CHECK(renderer::name_of(CasterKind::rays) == "rays");
  CHECK(renderer::name_of(CasterKind::profile) == "profile");
  CHECK_THROWS_AS(renderer::caster_wish("lidar"), core::InternalError);
}

TEST_CASE("A fan wider than 150 deg goes to rays", "[caster_choice]") {
  check_refused({.fan_rad = 2.7}, "at most 150 deg");
  CHECK(choose_caster(CasterWish::automatic, {.fan_rad = 2.6}).chosen == CasterKind::profile);
}
