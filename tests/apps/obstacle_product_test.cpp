// The product "obstacles" of fanbeam render, and the C-scope of mode shadow.
#include "session/products/obstacle_product.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/image.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

TEST_CASE("A table of obstacles names its columns, its input and what is a lower bound",
          "[render]") {
  sensors::ShadowObstacle obstacle;
  obstacle.azimuth_rad = 0.1;
  obstacle.range_m = 2084.275;
  obstacle.height_m = 8.09;
  obstacle.height_error_m = 0.26;
  obstacle.shadow_length_m = 188.4;
  obstacle.truncated = true;
  sensors::ShadowObstacle uncertain = obstacle;
  uncertain.uncertain = true;
  CHECK(session::obstacle_table({obstacle, uncertain},
                                {{"fanbeam:input", "abc"}, {"fanbeam:x", ""}}) ==
        "# obstacles, heights estimated from radar shadows\n# fanbeam:input abc\n# fanbeam:x \n"
        "range_m,azimuth_deg,height_m,error_m,shadow_m,truncated,merged,uncertain\n"
        "2084.28,5.730,8.09,0.26,188.4,1,0,0\n"
        "2084.28,5.730,,,188.4,1,0,1\n");
}

TEST_CASE("render writes obstacles and raises them in a C-scope of mode shadow", "[render]") {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "scene";
  fs::create_directories(scene);
  std::ifstream shipped(fs::path(FANBEAM_SOURCE_DIR) / "scenes/obstacle-field/scene.toml");
  std::ofstream(scene / "scene.toml")
      << shipped.rdbuf() << "\n[display]\ncscope_mode = \"shadow\"\n";
  const std::string words = " --frames 380 --effects=-double-bounce -q ";
  const auto run = [&](const std::string& what, const char* out) {
    const Result result = run_fanbeam("render " + quoted(scene) + words + what + " -o " +
                                      quoted(folder.path() / out));
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
  };
  run("--products cscope,obstacles", "out");
  std::ifstream table(folder.path() / "out/obstacles/00380.csv");
  std::string line;
  int walls = 0;
  std::getline(table, line);
  std::getline(table, line);
  while (std::getline(table, line))  // the wall, 8 m high, 2084 m away at -5.5 deg
    if (line.rfind("2084.28,-5.5", 0) == 0 && line.find(",7.9") != std::string::npos) ++walls;
  CHECK(walls == 1);
  std::string text;
  for (const auto& [key, value] : core::read_metadata(folder.path() / "out/cscope/00380.png"))
    if (key == "fanbeam:cscope") text = value;
  CHECK(text.find("shadow: ") == 0);
  CHECK(text.find("estimated") != std::string::npos);
  // Taken over only while the table is there.
  fs::remove(folder.path() / "out/obstacles/00380.csv");
  run("--products cscope,obstacles --resume", "out");
  CHECK(fs::exists(folder.path() / "out/obstacles/00380.csv"));
}
