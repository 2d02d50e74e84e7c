// scene.toml: read by itself, and put together where its terrain is small enough for a fuzzer.
#include "scenes/scene.h"

#include "core/files.h"
#include "core/text.h"
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

// Where render, fmcw and cost would write to when nobody says where.
void must_write_inside(const scenes::SceneDescription& scene) {
  if (scene.name.empty()) return;  // the file could not be parsed
  const std::filesystem::path out = fuzz::scratch_folder() / "out";
  for (const char* ending : {"", "-fmcw", "-cost"}) {
    const std::filesystem::path folder =
        fuzz::scratch_folder() / core::default_output_folder(scene.name, ending);
    fuzz::must(folder.parent_path() == out, "no file outside the output folder");
    core::write_file_atomically(folder / "run.json", "{}");
  }
  for (const auto& entry : std::filesystem::directory_iterator(fuzz::scratch_folder()))
    fuzz::must(entry.path() == out || entry.path().filename() == "scene.toml",
               "nothing beside the output folder");
  fuzz::must(core::is_printable_text(scene.name + scene.title + scene.sensor.name),
             "no control characters reach the terminal");
  std::filesystem::remove_all(out);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("scene.toml", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const scenes::SceneDescription scene =
        scenes::read_scene(file, {FANBEAM_SOURCE_DIR, {}, {}}, problems);
    must_write_inside(scene);
    if (problems.has_errors() || !is_small(scene)) return;
    scenes::build_scene(scene, {}, problems);
  });
  return 0;
}
