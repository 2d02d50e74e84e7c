// Side lobes that the plan leaves out are cut from the antenna that the scene is simulated with.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/files.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

namespace {

std::string sensor_with_level(const std::string& level_dB) {
  const std::string shipped = core::read_file(
      std::filesystem::path(FANBEAM_SOURCE_DIR) / "sensors" / "hivision.toml", 1U << 20U);
  return tests::replaced(shipped, "cut_deg = 1.25 ",
                         "side_lobe_level_dB = " + level_dB + "\ncut_deg = 1.25 ");
}

}  // namespace

TEST_CASE("faint side lobes are left out of the scene's antenna, strong ones stay", "[scene]") {
  const tests::TemporaryFolder folder;
  // Grass alone: where the ground mirrors walls or runway lights no echo has a bound.
  const std::string& small = tests::kSmallScene;
  const std::string open = small.substr(0, small.find("[[runway]]")) + tests::kFixed;
  const auto simulated = [&](const std::string& level_dB) {
    folder.write("lobes.toml", sensor_with_level(level_dB));
    const auto scene = tests::good_scene(folder, open + "[sensor]\nfile = \"lobes.toml\"\n");
    CHECK(scene->description.sensor.antenna.azimuth.side_lobe_gain > 0.0);
    const double level = scene->world.sensor.antenna.azimuth.side_lobe_gain;
    CHECK(scene->plan.runs(core::EffectId::side_lobes) == (level > 0.0));
    return level;
  };
  CHECK(simulated("-45.0") == Approx(std::pow(10.0, -4.5)));
  CHECK(simulated("-90.0") == 0.0);
}
