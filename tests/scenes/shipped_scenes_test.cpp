// Every scene that ships reads and builds, with its data or without any.
#include <catch2/catch.hpp>
#include <filesystem>

#include "core/effect_plan.h"
#include "scenes/frame_plan.h"
#include "tests/scenes/shipped_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

std::unique_ptr<scenes::Scene> built(const std::string& name,
                                     const std::vector<fs::path>& data = {}) {
  std::unique_ptr<scenes::Scene> scene = tests::shipped_scene(name, data);
  CHECK(scene->description.name == name);
  return scene;
}

}  // namespace

TEST_CASE("Scenes that bring all they need build without any data", "[shipped_scenes]") {
  CHECK(built("flat-grass")->frame_count() == 1);
  CHECK(built("obstacle-field")->frame_count() > 500);
  const std::unique_ptr<scenes::Scene> braunschweig = built("braunschweig-26");
  CHECK(braunschweig->frame_count() > 1200);
  CHECK(braunschweig->world.targets.size() > 2000);
}

TEST_CASE("Scenes on real terrain say exactly what is missing without their data",
          "[shipped_scenes]") {
  const std::vector<std::pair<std::string, std::vector<std::string>>> scenes = {
      {"innsbruck-26", {"terrain.elevation", "terrain.land_cover.file", "buildings[0].file"}},
      {"innsbruck-26-airliner",
       {"terrain.elevation", "terrain.land_cover.file", "buildings[0].file", "trajectory.file"}},
      {"keflavik-10", {"terrain.elevation", "trajectory.file"}}};
  for (const auto& [name, fields] : scenes) {
    const tests::Outcome outcome = tests::build(tests::kShippedScenes / name);
    std::vector<std::string> missing;
    for (const core::Problem& problem : outcome.problems) {
      CHECK(problem.code == "E-IO");
      CHECK(problem.place.line > 0);
      CHECK(problem.expected.find("--data DIR") != std::string::npos);
      missing.push_back(problem.field);
    }
    INFO(name);
    CHECK(missing == fields);
  }
}

TEST_CASE("Innsbruck builds on the shared terrain, both flights over it", "[shipped_scenes]") {
  const auto data = tests::shared_data("lowi-innsbruck");
  if (!data) return;
  CHECK(built("innsbruck-26", {data->parent_path()})->frame_count() > 1000);
  const auto flights = tests::shared_data("trajectories");
  if (!flights) return;
  const std::unique_ptr<scenes::Scene> airliner =
      built("innsbruck-26-airliner", {data->parent_path()});
  CHECK(airliner->frame_count() > 800);
  CHECK(airliner->trajectory->attitude_derived);
}

TEST_CASE("Keflavik flies the recorded attitude over the simulator's terrain", "[shipped_scenes]") {
  const auto data = tests::shared_data("bikf-keflavik");
  if (!data || !tests::shared_data("flightgear")) return;
  const std::unique_ptr<scenes::Scene> keflavik = built("keflavik-10", {data->parent_path()});
  CHECK(keflavik->frame_count() > 1800);
  CHECK_FALSE(keflavik->trajectory->attitude_derived);
  // Lava mirrors into lava from low above it, and nowhere before. With the shore that faces the antenna
  // and is the steepest ground of all, double bounce ran for 1800 frames.
  CHECK(keflavik->plan.runs(core::EffectId::double_bounce));
  CHECK(keflavik->caster.chosen == renderer::CasterKind::profile);
  for (const int frame : {0, 120, 240})
    CHECK_FALSE(scenes::frame_plan(*keflavik, frame).runs(core::EffectId::double_bounce));
}
