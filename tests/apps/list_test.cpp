// fanbeam list: what it names exists and works.
#include <algorithm>
#include <set>

#include "renderer/plan/effect_catalogue.h"
#include "session/products/products.h"
#include "tests/apps/program.h"
#include "tests/needed_program.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

nlohmann::json listed(const std::string& kind, const std::string& before = "") {
  const Result result = run_fanbeam("list " + kind + " --json", before);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return nlohmann::json::parse(result.output).at(kind);
}

std::set<std::string> names_of(const nlohmann::json& things) {
  std::set<std::string> names;
  for (const auto& thing : things) names.insert(thing.at("name").get<std::string>());
  return names;
}

// "detections/00000.png and .csv" and "preview.mp4, .gif or .apng": all, or the first.
std::vector<fs::path> files_named(const std::string& text) {
  const std::size_t end = std::min(text.find_first_of(" ,"), text.size());
  std::vector<fs::path> files = {text.substr(0, end)};
  if (const std::size_t more = text.find(" and "); more != std::string::npos)
    files.push_back(fs::path(files.front()).replace_extension(text.substr(more + 5)));
  return files;
}

}  // namespace

TEST_CASE("list scenes names every shipped scene with its title", "[cli][list]") {
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(FANBEAM_SOURCE_DIR "/scenes"))
    if (fs::exists(entry.path() / "scene.toml")) folders.insert(entry.path().filename().string());
  const nlohmann::json scenes = listed("scenes");
  CHECK((names_of(scenes) == folders));
  for (const auto& scene : scenes)
    CHECK(bytes_of(fs::path(scene.at("folder").get<std::string>()) / "scene.toml")
              .find("title = \"" + scene.at("title").get<std::string>() + "\"") !=
          std::string::npos);
}

TEST_CASE("list scenes tells which scenes lack their data, and which files these are",
          "[cli][list]") {
  // A program with its shipped files, but without data beside it.
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "apart/bin");
  fs::copy_file(FANBEAM_BINARY_DIR "/bin/fanbeam", folder.path() / "apart/bin/fanbeam");
  for (const char* shipped : {"scenes", "sensors", "materials"})
    fs::create_directory_symlink(fs::path(FANBEAM_SOURCE_DIR) / shipped,
                                 folder.path() / "apart" / shipped);
  const Result result =
      run_shell("env -u FANBEAM_DATA " + quoted(folder.path() / "apart/bin/fanbeam") +
                " list scenes --json 2>&1");
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  std::set<std::string> complete;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  for (const auto& scene : json.at("scenes")) {
    CHECK(scene.at("data_found").get<bool>() == scene.at("missing").empty());
    if (scene.at("data_found").get<bool>()) complete.insert(scene.at("name").get<std::string>());
    const std::string text =
        bytes_of(fs::path(scene.at("folder").get<std::string>()) / "scene.toml");
    for (const auto& file : scene.at("missing"))
      CHECK(text.find("\"" + file.get<std::string>() + "\"") != std::string::npos);
  }
  CHECK(complete.count("braunschweig-26") == 1);
  CHECK(complete.count("flat-grass") == 1);
  CHECK(complete.count("innsbruck-26") == 0);
  CHECK(complete.count("keflavik-10") == 0);
}

TEST_CASE("A sensor that list sensors names is one that --sensor takes", "[cli][list]") {
  const nlohmann::json sensors = listed("sensors");
  CHECK(names_of(sensors).count("hivision") == 1);
  for (const auto& sensor : sensors) {
    const std::string name = sensor.at("name").get<std::string>();
    // The grass of the scene is known from 30 to 100 GHz.
    const Result valid = run_fanbeam("validate flat-grass --sensor " + name);
    INFO(name << ": " << valid.output);
    CHECK(valid.exit_code == 0);
    CHECK(valid.output.find("sensor      " + sensor.at("radar").get<std::string>()) !=
          std::string::npos);
  }
  // HiVision, Table 2 of its source: 35 GHz, 41 deg in 164 columns, from 200 m.
  const auto& hivision = *std::find_if(sensors.begin(), sensors.end(), [](const auto& sensor) {
    return sensor.at("name") == "hivision";
  });
  CHECK(hivision.at("frequency_GHz").get<double>() == Approx(35.0));
  CHECK(hivision.at("band") == "Ka");
  CHECK(hivision.at("field_of_view_deg").get<double>() == Approx(41.0));
  CHECK(hivision.at("columns") == 164);
  CHECK(hivision.at("minimum_range_m").get<double>() == Approx(200.0));
}

TEST_CASE("list materials and effects name what the library and the plan know", "[cli][list]") {
  const nlohmann::json library = nlohmann::json::parse(run_fanbeam("materials --json").output);
  std::set<std::string> materials;
  for (const auto& row : library.at("materials"))
    materials.insert(row.at("material").get<std::string>());
  CHECK((names_of(listed("materials")) == materials));
  std::set<std::string> effects;
  for (const auto touched :
       {fanbeam::renderer::Touches::pictures, fanbeam::renderer::Touches::samples})
    for (const auto& effect : fanbeam::renderer::effect_catalogue(touched))
      effects.emplace(effect.name());
  CHECK((names_of(listed("effects")) == effects));
}

TEST_CASE("A product that list products names is made, in the files that it names", "[cli][list]") {
  const nlohmann::json products = listed("products");
  const bool has_ffmpeg = needed_program("ffmpeg");  // for the preview
  const TemporaryFolder folder;
  std::string all;
  for (const auto& product : products)
    if (product.at("command") == "render" && (has_ffmpeg || product.at("name") != "preview"))
      all += (all.empty() ? "" : ",") + product.at("name").get<std::string>();
  const Result made = run_fanbeam("render flat-grass -q --products " + all + " -o " +
                                  quoted(folder.path() / "out"));
  INFO(made.output);
  REQUIRE(made.exit_code == 0);
  std::size_t found = 0;
  for (const auto& product : products) {
    CHECK_FALSE(product.at("what").get<std::string>().empty());
    REQUIRE_FALSE(product.at("files").get<std::string>().empty());
    if (product.at("command") != "render") continue;
    if (!has_ffmpeg && product.at("name") == "preview") continue;
    for (const fs::path& file : files_named(product.at("files").get<std::string>())) {
      INFO(file.string());
      CHECK(fs::is_regular_file(folder.path() / "out" / file));
      ++found;
    }
  }
  CHECK(found >= fanbeam::session::kProducts.size());
}

TEST_CASE("list alone names everything; --names gives bare names; another kind is refused",
          "[cli][list]") {
  const Result all = run_fanbeam("list");
  CHECK(all.exit_code == 0);
  for (const char* line : {"scenes     braunschweig-26 ", "\nsensors    ",
                           "\nmaterials  short_grass", "\neffects    gas ", "\nproducts   bscope "})
    CHECK(all.output.find(line) != std::string::npos);
  const Result names = run_fanbeam("list sensors --names");
  std::istringstream lines(names.output);
  std::set<std::string> bare;
  for (std::string line; std::getline(lines, line);) bare.insert(line);
  CHECK((bare == names_of(listed("sensors"))));
  CHECK(run_fanbeam("list nonsense").exit_code == 2);
  const Result everything = run_fanbeam("list --json");
  CHECK(nlohmann::json::parse(everything.output).size() == 5);
}
