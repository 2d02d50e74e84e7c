// Every key that the readers of scenes ask for stands in docs/scene-format.md.
#include <cctype>
#include <set>

#include "core/files.h"
#include "renderer/casting/sampling.h"
#include "tests/scenes/full_scene.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

// The words in backticks of the part on scene files.
std::set<std::string> documented_words() {
  std::string text = core::read_file(FANBEAM_SOURCE_DIR "/docs/scene-format.md", 1U << 22U);
  text.resize(text.find("\n# Sensor files"));
  std::set<std::string> words;
  bool code = false;
  std::string word;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      word += c;
      continue;
    }
    if (code && !word.empty()) words.insert(word);
    word.clear();
    if (c == '`') code = !code;
  }
  return words;
}

// "box[2].at.left_m" is box, at and left_m.
std::set<std::string> words_of(const std::string& key) {
  std::set<std::string> words;
  std::string word;
  bool index = false;
  for (const char c : key + ".") {
    if (c == '[') index = true;
    if (c == '.') {
      words.insert(word);
      word.clear();
      index = false;
    } else if (!index) {
      word += c;
    }
  }
  return words;
}

}  // namespace

TEST_CASE("The documented defaults of rays per cell and slices are the renderer's",
          "[scene_reader][docs]") {
  const std::string text = core::read_file(FANBEAM_SOURCE_DIR "/docs/scene-format.md", 1U << 22U);
  CHECK(text.find("stands for the program's default, " +
                  core::number_text(renderer::kDefaultRaysPerCell) + " |") != std::string::npos);
  CHECK(text.find("0 stands for " + core::number_text(renderer::kDefaultSlicesPerColumn) + ")") !=
        std::string::npos);
}

TEST_CASE("Every setting of run.json's input is documented", "[scene_reader][docs]") {
  const std::set<std::string> documented = documented_words();
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
  const auto check = [&](const std::filesystem::path& scene) {
    for (const auto& [key, value] : tests::read(scene).resolved) {
      // Keys that the user chooses: classes of a raster, materials of a model.
      if (key.find("land_cover.classes.") != std::string::npos ||
          key.find("].materials.") != std::string::npos)
        continue;
      for (const std::string& word : words_of(key)) {
        INFO(scene << ": " << key);
        CHECK(documented.contains(word));
      }
    }
  };
  check(folder.path());
  for (const char* shipped : {"braunschweig-26", "flat-grass", "obstacle-field", "rain-94ghz"})
    check(std::filesystem::path(FANBEAM_SOURCE_DIR) / "scenes" / shipped);
}
