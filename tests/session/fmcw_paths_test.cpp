// Which echoes of a frame become paths of a signal.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "session/signal/paths.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

TEST_CASE("Behind a linear array there are no paths, of surfaces or of targets", "[fmcw]") {
  const auto target = [](const std::string& longitude_deg, const std::string& latitude_deg) {
    return "[[target]]\nat = { latitude_deg = " + latitude_deg +
           ", longitude_deg = " + longitude_deg +
           " }\nabove_ground_m = 60.0\nrcs = { shape = \"constant\", rcs_dBsm = 10 }\n";
  };
  const tests::TemporaryFolder folder;
  // 50 m to the north-east, and 50 m to the south-east.
  folder.write("scene.toml", tests::standing() + target("10.00051", "52.000315") +
                                 target("10.00051", "51.999685") +
                                 "[sensor]\nfile = \"automotive-76.toml\"\n");
  core::ProblemList problems;
  scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  description.sensor.scan.field_of_view_rad = 2.0 * core::kPi;
  const auto scene = scenes::build_scene(description, {}, problems);
  session::FmcwSettings settings;
  const session::FmcwPaths found = session::fmcw_paths(*scene, 0, settings);
  const auto near = [&](double azimuth_rad) {
    return std::any_of(found.targets.begin(), found.targets.end(), [&](const core::Echo& echo) {
      return std::abs(echo.azimuth_rad - azimuth_rad) < 0.05;
    });
  };
  CHECK(near(core::kPi / 4));
  CHECK_FALSE(near(3.0 * core::kPi / 4));
  REQUIRE(found.paths.size() > 1);
  for (const signal::ScatterPath& path : found.paths)
    REQUIRE(std::abs(path.azimuth_rad) <= core::kPi / 2);
}
