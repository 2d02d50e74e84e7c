// A scene means the same wherever it lies and whatever the machine's locale (F18), and finds its
// files in a fixed order.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>

#include "tests/comma_locale.h"
#include "tests/scenes/full_scene.h"

using namespace fanbeam;
using namespace fanbeam::scenes;
using tests::read;
using tests::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE(
    "Files are looked for in the scene's folder, its data folders in order, then those of the "
    "command line",
    "[scene_places]") {
  const TemporaryFolder folder;
  const TemporaryFolder other;
  tests::write_full_scene(folder);
  fs::create_directories(other.path() / "even more");
  for (const char* name : {"dem.asc", "town.geojson", "cover.asc"}) other.write(name, "");
  CHECK(read(folder.path(), {other.path()}).buildings[0].file ==
        folder.path() / "more data/town.geojson");
  fs::remove(folder.path() / "more data/town.geojson");
  CHECK(read(folder.path(), {other.path()}).buildings[0].file ==
        folder.path() / "even more/town.geojson");
  fs::remove(folder.path() / "even more/town.geojson");
  fs::remove(folder.path() / "dem.asc");
  const SceneDescription scene = read(folder.path(), {"/nowhere", other.path()});
  CHECK(scene.buildings[0].file == other.path() / "town.geojson");
  CHECK(scene.terrain.elevation == other.path() / "dem.asc");
  CHECK(scene.terrain.land_cover == folder.path() / "cover.asc");
}

TEST_CASE("F18 a folder with blanks and letters beyond ASCII, read from anywhere",
          "[scene_places]") {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "Anflug Zürich 14 – 東";
  fs::create_directories(scene);
  folder.write(
      "Anflug Zürich 14 – 東/scene.toml",
      tests::replaced(tests::kSmallScene,
                      "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 1500.0",
                      "[trajectory]\nfile = \"Flug Nº 1.csv\"\nvertical_datum = \"scene\""));
  folder.write("Anflug Zürich 14 – 東/Flug Nº 1.csv",
               "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n");
  const tests::Outcome whole = tests::build(scene);
  REQUIRE(whole.scene != nullptr);

  const fs::path before = fs::current_path();
  fs::current_path(scene);
  const SceneDescription here = read(".");
  const SceneDescription by_file = read("scene.toml");
  fs::current_path(folder.path());
  const SceneDescription relative = read("Anflug Zürich 14 – 東");
  fs::current_path(before);
  for (const SceneDescription* read_elsewhere : {&here, &by_file, &relative}) {
    CHECK((read_elsewhere->resolved == whole.scene->description.resolved));
    CHECK(read_elsewhere->folder == whole.scene->description.folder);
    CHECK(read_elsewhere->trajectory.file == whole.scene->description.trajectory.file);
  }
}

TEST_CASE("F18 a locale with a decimal comma changes nothing", "[scene_places]") {
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
  const fs::path braunschweig = fs::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26";
  const SceneDescription plain = read(folder.path());
  const std::unique_ptr<Scene> plain_scene = tests::build(braunschweig).scene;
  REQUIRE(plain_scene != nullptr);

  const tests::CommaLocale made;
  std::optional<tests::HeldCommaLocale> held;  // for C; the other one is for C++
  if (made.made()) held.emplace(made);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  std::ostringstream proof;
  proof << 1234.5;
  const SceneDescription comma = read(folder.path());
  const std::unique_ptr<Scene> comma_scene = tests::build(braunschweig).scene;
  if (held) CHECK(std::strtod("1,5", nullptr) == 1.5);
  std::locale::global(before);
  held.reset();

  CHECK(proof.str() == "1.234,5");
  CHECK((comma.resolved == plain.resolved));
  REQUIRE(comma_scene != nullptr);
  CHECK(comma_scene->world.surfaces().terrain()->height_m ==
        plain_scene->world.surfaces().terrain()->height_m);
  CHECK(comma_scene->world.surfaces().triangle_count() ==
        plain_scene->world.surfaces().triangle_count());
  const core::Pose a = plain_scene->trajectory->at(10.0);
  const core::Pose b = comma_scene->trajectory->at(10.0);
  CHECK(a.position.latitude_rad == b.position.latitude_rad);
  CHECK(a.position.height_m == b.position.height_m);
}

TEST_CASE("docs/scene-format.md names every key that a scene can have", "[scene_places]") {
  const TemporaryFolder folder;
  tests::write_full_scene(folder);
  std::ifstream stream(fs::path(FANBEAM_SOURCE_DIR) / "docs/scene-format.md");
  std::ostringstream document;
  document << stream.rdbuf();
  const std::string text = document.str();
  const SceneDescription full = read(folder.path());
  const SceneDescription rolling = read(fs::path(FANBEAM_SOURCE_DIR) / "scenes/braunschweig-26");
  const SceneDescription flat = read(fs::path(FANBEAM_SOURCE_DIR) / "scenes/flat-grass");
  std::vector<std::string> missing;
  for (const SceneDescription* scene : {&full, &rolling, &flat}) {
    for (const auto& entry : scene->resolved) {
      std::string key = entry.first.substr(entry.first.rfind('.') + 1);
      key = key.substr(0, key.find('['));
      const bool free_form = entry.first.find(".classes.") != std::string::npos ||
                             entry.first.find(".materials.") != std::string::npos;
      if (!free_form && text.find("`" + key + "`") == std::string::npos)
        missing.push_back(entry.first);
    }
  }
  for (const std::string& key : missing) UNSCOPED_INFO(key);
  CHECK(missing.empty());
}
