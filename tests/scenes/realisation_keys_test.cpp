// Keys of scene.toml that ask for a realisation, and what they make of the plan.
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;

namespace {

const std::string kDrone =
    "[[target]]\nname = \"drone\"\nat = { runway = \"36\", behind_threshold_m = 100.0 }\n"
    "above_ground_m = 20.0\nrcs = { shape = \"constant\" }\n";

std::string scene_text(const std::string& target_key, const std::string& accuracy) {
  return tests::replaced(tests::kSmallScene, "[weather]",
                         kDrone + target_key + "\n[accuracy]\n" + accuracy + "\n[weather]");
}

}  // namespace

TEST_CASE("realisation and swerling reach the plan and the targets", "[scene]") {
  const tests::TemporaryFolder folder;
  const auto mean = tests::good_scene(folder, scene_text("swerling = 3", ""));
  CHECK_FALSE(mean->plan.runs(core::EffectId::speckle));
  CHECK_FALSE(mean->plan.runs(core::EffectId::swerling));
  CHECK(mean->world.targets.back().swerling == core::Swerling::case3);
  CHECK(mean->world.targets.front().swerling == core::Swerling::steady);  // a runway light

  const auto sample =
      tests::good_scene(folder, scene_text("swerling = 3", "realisation = \"sample\""));
  CHECK(sample->plan.runs(core::EffectId::speckle));
  CHECK(sample->plan.runs(core::EffectId::swerling));
  const auto steady = tests::good_scene(folder, scene_text("", "realisation = \"sample\""));
  CHECK(steady->plan.runs(core::EffectId::speckle));
  CHECK_FALSE(steady->plan.runs(core::EffectId::swerling));
}

TEST_CASE("realisation and swerling refuse other values", "[scene]") {
  const tests::TemporaryFolder folder;
  for (const std::string key : {"swerling = 5", "swerling = -1", "swerling = 1.5"})
    CHECK(tests::build_text(folder, scene_text(key, "")).scene == nullptr);
  for (const std::string key : {"realisation = \"draw\"", "realisation = 1"})
    CHECK(tests::build_text(folder, scene_text("", key)).scene == nullptr);
}
