// What a scene file says about rays or slices, and what its contents allow.
#include <optional>

#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using renderer::CasterKind;
using renderer::CasterWish;

namespace {

const std::string kTruck =
    "[[model]]\nfile = \"truck.gltf\"\nat = { runway = \"36\", behind_threshold_m = 300.0 }\n"
    "default_material = \"metal\"\n";
const std::string kTilted = "[sensor]\nstabilised = false\n";

// A folder that the truck's model lies in.
struct TruckFolder : tests::TemporaryFolder {
  TruckFolder() {
    std::filesystem::copy_file(FANBEAM_SOURCE_DIR "/scenes/braunschweig-26/truck.gltf",
                               path() / "truck.gltf");
  }
};

// The small scene, whose hangar is a prism on the ground, with these tables before its weather.
std::string with(const std::string& tables) {
  return tests::replaced(tests::kSmallScene, "[weather]", tables + "[weather]");
}

std::string wish(const std::string& caster) { return "[accuracy]\ncaster = " + caster + "\n"; }

// Built with a wish of the command line.
std::vector<core::Problem> problems_of(const tests::TemporaryFolder& folder,
                                       const std::string& text, std::optional<CasterWish> asked,
                                       renderer::CasterChoice* choice = nullptr) {
  folder.write("scene.toml", text);
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  scenes::BuildOptions options;
  options.caster = asked;
  try {
    const auto scene = scenes::build_scene(description, options, problems);
    if (choice != nullptr) *choice = scene->caster;
  } catch (const core::InputError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

TEST_CASE("A scene with a building is seen by slices unless it says otherwise", "[scene_caster]") {
  const TruckFolder folder;
  const auto left_alone = tests::good_scene(folder, with(""));
  CHECK(left_alone->caster.chosen == CasterKind::profile);
  CHECK(left_alone->caster.wish == CasterWish::automatic);
  CHECK(tests::good_scene(folder, with(wish("\"rays\"")))->caster.chosen == CasterKind::rays);
  const auto forced = tests::good_scene(folder, with(wish("\"profile\"")));
  CHECK(forced->caster.chosen == CasterKind::profile);
  CHECK(forced->caster.wish == CasterWish::profile);
  CHECK(forced->caster.others == 0);  // the hangar is cut by the slices
  const auto open = tests::good_scene(folder, with(wish("\"auto\"")));
  CHECK(open->caster.chosen == CasterKind::profile);
  CHECK(open->caster.wish == CasterWish::automatic);
}

TEST_CASE("A scene without a building is seen by slices while its plan runs double bounce",
          "[scene_caster]") {
  const TruckFolder folder;
  std::string open = with(kTruck);
  open.erase(open.find("[[box]]"), open.find("[[model]]") - open.find("[[box]]"));
  const auto scene = tests::good_scene(folder, open);
  REQUIRE(scene->plan.runs(core::EffectId::double_bounce));
  CHECK(scene->caster.chosen == CasterKind::profile);
  CHECK(scene->caster.reason.starts_with("with double bounce slices come as close"));
  // Conditions change the plan, and with it the caster.
  core::ProblemList problems;
  const auto without = scenes::under_conditions(
      *scene, {.wishes = renderer::parse_effect_wishes("-double-bounce")}, problems);
  CHECK(without->caster.chosen == CasterKind::rays);
  CHECK(scenes::under_conditions(*without, {.wishes = renderer::EffectWishes{}}, problems)
            ->caster.chosen == CasterKind::profile);
}

TEST_CASE("A model takes its azimuths from slices, and all of them when the antenna tilts",
          "[scene_caster]") {
  const TruckFolder folder;
  const auto level = tests::good_scene(folder, with(wish("\"profile\"") + kTruck));
  CHECK(level->caster.chosen == CasterKind::profile);
  CHECK(level->caster.others == 1);
  const auto tilted = tests::good_scene(folder, with(wish("\"auto\"") + kTruck + kTilted));
  CHECK(tilted->caster.chosen == CasterKind::rays);
  CHECK(tilted->caster.reason.find("not stabilised") != std::string::npos);
  // Without the truck slices see the tilted scene.
  CHECK(tests::good_scene(folder, with(wish("\"profile\"") + kTilted))->caster.chosen ==
        CasterKind::profile);
}

TEST_CASE("On a round Earth even a stabilised antenna is not level far from the origin",
          "[scene_caster]") {
  const TruckFolder folder;
  // 1 mrad of the Earth's 6371 km is 6.4 km.
  const auto chosen = [&](const std::string& distance_m, const std::string& earth) {
    std::string text = with(wish("\"auto\"") + kTruck);
    text = tests::replaced(text, "start_distance_m = 1500.0", "start_distance_m = " + distance_m);
    text = tests::replaced(text, "half_extent_m = 2500.0", "half_extent_m = 8000.0");
    text = tests::replaced(text, "[terrain]", earth + "[terrain]");
    return tests::good_scene(folder, text)->caster.chosen;
  };
  CHECK(chosen("6000.0", "") == CasterKind::profile);
  // Of an approach that begins farther away the frames out there alone are of rays.
  const auto far = [&](const std::string& earth) {
    std::string text = with(wish("\"auto\"") + kTruck);
    text = tests::replaced(text, "start_distance_m = 1500.0", "start_distance_m = 7000.0");
    text = tests::replaced(text, "half_extent_m = 2500.0", "half_extent_m = 8000.0");
    text = tests::replaced(text, "[terrain]", earth + "[terrain]");
    return tests::good_scene(folder, text)->caster;
  };
  CHECK(far("").chosen == CasterKind::profile);
  CHECK(far("").reason.find("frames from beyond 6 km") != std::string::npos);
  CHECK(far("earth = \"plane\"\n").reason.find("frames from") == std::string::npos);
}

TEST_CASE("Slices forced where they cannot show the scene are told at the line that forces them",
          "[scene_caster]") {
  const TruckFolder folder;
  const std::string refused =
      "E-UNSUPPORTED caster = \"profile\": expected \"rays\" or \"auto\": slices cannot show the "
      "model or building part over open air because the antenna is not stabilised";
  const std::string text = with(wish("\"profile\"") + kTruck + kTilted);
  const tests::Outcome outcome = tests::build_text(folder, text);
  CHECK(outcome.scene == nullptr);
  CHECK(tests::messages(folder, outcome.problems) ==
        std::vector<std::string>{"@/scene.toml:23:1: " + refused});

  // The command line's wish stands for the scene's, both ways.
  renderer::CasterChoice choice;
  CHECK(problems_of(folder, text, CasterWish::rays, &choice).empty());
  CHECK(choice.chosen == CasterKind::rays);
  CHECK(problems_of(folder, text, CasterWish::automatic, &choice).empty());
  CHECK(choice.chosen == CasterKind::rays);
  const auto forced = problems_of(folder, with(kTruck + kTilted), CasterWish::profile);
  REQUIRE(forced.size() == 1);
  CHECK(core::to_string(forced[0]) == refused);
}

TEST_CASE("caster refuses other words", "[scene_caster]") {
  const tests::TemporaryFolder folder;
  for (const char* caster : {"\"lidar\"", "\"automatic\"", "1"})
    CHECK(tests::build_text(folder, with(wish(caster))).scene == nullptr);
}
