// Materials of ASAM OpenMATERIAL 3D files on models: what the scene makes of them, and that the
// picture is as bright as they say.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "renderer/frame.h"
#include "tests/scenes/built_scene.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::replaced;
using tests::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

// A wall of 20 m by 20 m that looks along -Z of glTF, one half "Steel", the other "Panel".
std::string wall_gltf(const std::string& second_material = "Panel") {
  std::string bytes;
  for (const float x : {-10.0F, 0.0F, 10.0F})
    for (const float y : {0.0F, 20.0F})
      for (const float value : {x, y, 0.0F})
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (const int shift : {18, 12, 6, 0}) base64 += digits[(word >> shift) & 63];
  }
  nlohmann::json document = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "materials": [{"name": "Steel"}, {}],
    "meshes": [{"primitives": [
      {"attributes": {"POSITION": 0}, "material": 0, "mode": 5},
      {"attributes": {"POSITION": 1}, "material": 1, "mode": 5}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 0, "byteOffset": 24, "componentType": 5126, "count": 4, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 72}],
    "buffers": [{"byteLength": 72}]})");
  document["materials"][1]["name"] = second_material;
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  return document.dump();
}

// A wall 1000 m north of a radar that looks north.
std::string wall_scene(const std::string& model_keys) {
  return replaced(tests::standing(), "[weather]", R"([[model]]
file = "wall.gltf"
at = { runway = "36", behind_threshold_m = 1000.0 }
)" + model_keys + "\n[weather]");
}

void write_model(const TemporaryFolder& folder) {
  fs::copy(fs::path(FANBEAM_SOURCE_DIR) / "tests" / "data" / "open_material", folder.path(),
           fs::copy_options::recursive);
  folder.write("wall.gltf", wall_gltf());
}

double sum_W(const scenes::Scene& scene) {
  const renderer::Frame frame =
      renderer::render_frame(scene.world, renderer::sampling_for(4.0), {}, {}, scene.frame_pose(0));
  double sum_W = 0.0;
  for (const double power_W : frame.bscope_W) sum_W += power_W;
  return sum_W;
}

const materials::NrcsCurve& curve_of(const scenes::Scene& scene, const std::string& name) {
  const auto& names = scene.world.geometry->material_names;
  const auto found = std::find(names.begin(), names.end(), name);
  INFO(name);
  REQUIRE(found != names.end());
  return scene.world.nrcs.curves().at(static_cast<std::size_t>(found - names.begin()));
}

}  // namespace

TEST_CASE("Names of a mapping become materials of the model, behind the library's",
          "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  const auto scene = tests::good_scene(folder, wall_scene("open_material = \"block.xoma\""));
  REQUIRE(scene->world.nrcs.size() == scene->world.geometry->material_names.size());
  CHECK(scene->world.geometry->material_names.end()[-2] == "wall.gltf:Steel");
  CHECK(scene->world.geometry->material_names.end()[-1] == "wall.gltf:Panel");
  // HiVision sends and receives HH at 35 GHz: 0.5 sin + 2 sin^8, and 4 pi 0.05 cos^2 at 60 deg.
  CHECK(curve_of(*scene, "wall.gltf:Steel").sigma0(0.5) == Approx(0.25 + 2.0 / 256.0));
  CHECK(curve_of(*scene, "wall.gltf:Panel").sigma0(1.0) == Approx(4.0 * 3.14159265 * 0.05));
  // Every file is part of the scene's fingerprint, and the materials stand in run.json.
  for (const char* name : {"block.xoma", "block.xomm", "steel.xomp", "panel.xomp",
                           "panel_brdf.xompt", "panel_reflCoeff.xompt"}) {
    const auto& files = scene->description.files;
    CHECK(std::count_if(files.begin(), files.end(),
                        [&](const fs::path& file) { return file.filename() == name; }) == 1);
  }
  CHECK(scene->surfaces.end()[-1].material == "wall.gltf:Panel");
  CHECK(scene->surfaces.end()[-1].model == "tabulated");
}

TEST_CASE("A material with a surface height and a permittivity mirrors; one without does not",
          "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  folder.write("wall.gltf", wall_gltf("Concrete"));
  const std::string text =
      replaced(wall_scene("open_material = \"block.xoma\""), "short_grass", "forest");
  const auto scene = tests::good_scene(folder, text);
  const auto& names = scene->world.geometry->material_names;
  const auto mirror_of = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    REQUIRE(at != names.end());
    return scene->world.specular.at(static_cast<std::size_t>(at - names.begin()));
  };
  const auto concrete = mirror_of("wall.gltf:Concrete");
  REQUIRE(concrete);
  CHECK(concrete->rms_height_m == Approx(0.0005));
  CHECK(concrete->permittivity.real == Approx(5.24).epsilon(0.0).margin(0.05));
  CHECK_FALSE(mirror_of("wall.gltf:Steel").has_value());  // a height, but no permittivity
  // Forest mirrors nothing: this wall alone makes corners worth a look.
  CHECK(scene->plan.runs(core::EffectId::double_bounce));
}

TEST_CASE(
    "New weather turns a model's materials to its temperature, as if the scene were opened with it",
    "[open_material]") {
  // HiVision's 8.566 mm lies between the rows of 4 and 10 mm; those of 273 to 293 K differ.
  const auto text = [](const std::string& weather) {
    return replaced(wall_scene("open_material = \"block.xoma\""), "[weather]",
                    "[weather]\n" + weather);
  };
  const TemporaryFolder folder;
  write_model(folder);
  folder.write("wall.gltf", wall_gltf("Concrete"));
  const auto cold = tests::good_scene(folder, text("temperature_C = -5.0"));
  const auto warm = tests::good_scene(folder, text("temperature_C = 30.0"));
  core::ProblemList problems;
  const auto turned =
      scenes::under_conditions(*cold, {.weather = warm->description.weather}, problems);
  CHECK(problems.all().empty());
  const std::string name = "wall.gltf:Concrete";
  const double cold_sigma0 = curve_of(*cold, name).sigma0(0.7);
  CHECK(curve_of(*warm, name).sigma0(0.7) > 1.01 * cold_sigma0);
  CHECK(curve_of(*turned, name).sigma0(0.7) == curve_of(*warm, name).sigma0(0.7));
  CHECK(turned->world.specular.back() == warm->world.specular.back());
  CHECK(sum_W(*turned) == sum_W(*warm));
  // And back, from either; other weather of that temperature shares the site.
  const auto back =
      scenes::under_conditions(*turned, {.weather = cold->description.weather}, problems);
  CHECK(sum_W(*back) == sum_W(*cold));
  atmosphere::Weather rain = cold->description.weather;
  rain.temperature_C = -10.0;
  CHECK(scenes::under_conditions(*cold, {.weather = rain}, problems)->site == cold->site);
}

TEST_CASE("A temperature at which a model's material is not known is refused", "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  folder.write("wall.gltf", wall_gltf("Concrete"));
  std::ifstream file(folder.path() / "materials/concrete_emp.xompt");
  const std::string table(std::istreambuf_iterator<char>(file), {});
  folder.write("materials/concrete_emp.xompt",
               replaced(table, "[0.01, 293, 50, 1, 0,", "[0.01, 293, 50, 2, 0,"));
  const auto cold =
      tests::good_scene(folder, replaced(wall_scene("open_material = \"block.xoma\""), "[weather]",
                                         "[weather]\ntemperature_C = -5.0"));
  atmosphere::Weather warm = cold->description.weather;
  warm.temperature_C = 30.0;
  core::ProblemList problems;
  REQUIRE_THROWS_AS(scenes::under_conditions(*cold, {.weather = warm}, problems), core::InputError);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-UNSUPPORTED");
  CHECK(problems.all()[0].field == "temperature_C");
  CHECK(problems.all()[0].value == "30");
  CHECK(problems.all()[0].expected ==
        "one that wall.gltf:Concrete is known at: a magnetic medium, mu other than 1");
}

TEST_CASE("The wall's echo is as strong as its material says", "[open_material]") {
  // One wall under three strengths of "a" alone: what the ground adds drops out of the ratio.
  const auto power_W = [](const std::string& a) {
    const TemporaryFolder folder;
    write_model(folder);
    std::ifstream file(folder.path() / "materials/steel.xomp");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    folder.write("materials/steel.xomp",
                 replaced(text, "\"a\": 0.5, \"b\": 2, \"c\": 8", "\"a\": " + a));
    folder.write("wall.gltf", wall_gltf("Old_Steel"));  // replaced by Steel in the asset
    return sum_W(*tests::good_scene(folder, wall_scene("open_material = \"block.xoma\"")));
  };
  const double nothing_W = power_W("0"), weak_W = power_W("0.5"), strong_W = power_W("5");
  CHECK(strong_W > 1.1 * nothing_W);
  CHECK((strong_W - nothing_W) / (weak_W - nothing_W) == Approx(10.0).epsilon(1e-6));
}

TEST_CASE("A wall under its own material looks as under the same material of a library",
          "[open_material]") {
  const auto power_W = [](const std::string& keys) {
    const TemporaryFolder folder;
    write_model(folder);
    folder.write("wall.gltf", wall_gltf("Old_Steel"));
    std::ifstream file(fs::path(FANBEAM_SOURCE_DIR) / "materials" / "library.toml");
    folder.write("mine.toml", std::string(std::istreambuf_iterator<char>(file), {}) + R"(
[own_steel]
model = "phong"
a = 0.5
b = 2.0
c = 8.0
reference_frequency_GHz = 35
frequency_exponent = 0
frequency_range_GHz = [30, 40]
grazing_range_deg = [1, 90]
polarisation = "any"
confidence = "assumed"
source = "as the test's steel"
)");
    return sum_W(
        *tests::good_scene(folder, "material_library = \"mine.toml\"\n" + wall_scene(keys)));
  };
  CHECK(power_W("open_material = \"block.xoma\"") ==
        power_W("materials = { Steel = \"own_steel\", Old_Steel = \"own_steel\" }"));
}

TEST_CASE("The scene's own mapping goes before the files, the default behind them",
          "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  folder.write("wall.gltf", wall_gltf("Cloth"));  // that the mapping does not know
  const auto scene = tests::good_scene(
      folder, wall_scene("open_material = \"block.xomm\"\ndefault_material = \"forest\"\n"
                         "materials = { Steel = \"concrete\" }"));
  const auto& names = scene->world.geometry->material_names;
  CHECK(std::count_if(names.begin(), names.end(),
                      [](const std::string& name) { return name.starts_with("wall.gltf"); }) == 0);
}

TEST_CASE("A mapping of a material that the model has not names those it has", "[open_material]") {
  const TemporaryFolder folder;
  folder.write("wall.gltf", wall_gltf("Painted_Steel"));
  const tests::Outcome outcome =
      tests::build_text(folder, wall_scene("materials = { Painted = \"concrete\" }"));
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems[0].code == "W-UNUSED");
  CHECK(outcome.problems[0].expected ==
        "no triangle of wall.gltf has this material; perhaps Painted_Steel of Steel, "
        "Painted_Steel");
}

TEST_CASE("An asset of the model's own name is used when asked for, and only then",
          "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  fs::rename(folder.path() / "block.xoma", folder.path() / "wall.xoma");
  const auto materials_beyond_library = [&](const std::string& keys) {
    const auto scene = tests::good_scene(folder, wall_scene(keys));
    const auto& names = scene->world.geometry->material_names;
    return std::count_if(names.begin(), names.end(),
                         [](const std::string& name) { return name.starts_with("wall.gltf"); });
  };
  CHECK(materials_beyond_library("open_material = \"auto\"") == 2);
  CHECK(materials_beyond_library("") == 0);
  fs::remove(folder.path() / "wall.xoma");
  const tests::Outcome outcome = tests::build_text(folder, wall_scene("open_material = \"auto\""));
  REQUIRE(outcome.scene == nullptr);
  CHECK(outcome.problems.front().code == "E-IO");
  CHECK(outcome.problems.front().field == "model[0].open_material");
}

TEST_CASE("Two copies of a model share their materials", "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  const std::string one = wall_scene("open_material = \"block.xoma\"");
  const std::string second =
      one.substr(one.find("[[model]]"), one.find("[weather]") - one.find("[[model]]"));
  const auto scene = tests::good_scene(folder, replaced(one, "[weather]", second + "[weather]"));
  const auto& names = scene->world.geometry->material_names;
  CHECK(std::count(names.begin(), names.end(), "wall.gltf:Steel") == 1);
}

TEST_CASE("Materials that serve no radar, and files outside, fail the scene with their places",
          "[open_material]") {
  const TemporaryFolder folder;
  write_model(folder);
  folder.write("wall.gltf", wall_gltf("Glass"));
  const tests::Outcome outcome =
      tests::build_text(folder, wall_scene("open_material = \"block.xoma\""));
  REQUIRE(outcome.scene == nullptr);
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems.front().code == "E-UNSUPPORTED");
  CHECK(fs::path(outcome.problems.front().place.file).filename() == "glass.xomp");

  const tests::Outcome outside =
      tests::build_text(folder, wall_scene("open_material = \"../block.xoma\""));
  REQUIRE(outside.scene == nullptr);
  CHECK(outside.problems.front().code == "E-PATH");
}
