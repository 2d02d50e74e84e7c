// scene.toml: read by itself, and put together where its terrain is small enough for a fuzzer.
#include "scenes/scene.h"

#include "scenes/scene_reader.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

namespace {

// Building a usual scene takes seconds under the sanitizers.
bool is_small(const scenes::SceneDescription& scene) {
  constexpr double kMostPosts = 3000.0;
  const scenes::TerrainDescription& terrain = scene.terrain;
  const double columns = (terrain.east_m - terrain.west_m) / terrain.spacing_m + 1.0;
  const double rows = (terrain.north_m - terrain.south_m) / terrain.spacing_m + 1.0;
  return columns * rows <= kMostPosts;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("scene.toml", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const scenes::SceneDescription scene =
        scenes::read_scene(file, {FANBEAM_SOURCE_DIR, {}, {}}, problems);
    if (problems.has_errors() || !is_small(scene)) return;
    scenes::build_scene(scene, {}, problems);
  });
  return 0;
}
