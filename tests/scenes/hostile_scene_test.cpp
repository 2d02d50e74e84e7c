// Scenes that want too much: files outside their folder, more objects than there is memory for,
// texts that keep a reader busy. docs/scene-format.md, "Limits".
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes/file_budget.h"
#include "scenes/model_materials.h"
#include "scenes/objects.h"
#include "tests/peak_memory.h"
#include "tests/processor_time.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::check_problems;
using tests::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestScene_bytes = std::size_t{4} << 20;

// As many of `part` as a scene file may hold, numbered where it has a '#'.
std::string filled(const std::string& before, const std::string& part, const std::string& behind) {
  std::string text = before;
  for (std::size_t i = 0; text.size() + part.size() + behind.size() + 10 < kLargestScene_bytes;
       ++i) {
    const std::size_t number = part.find('#');
    text += part.substr(0, number);
    if (number != std::string::npos) text += std::to_string(i) + part.substr(number + 1);
  }
  return text + behind;
}

std::string codes_of(const std::vector<core::Problem>& problems) {
  std::string codes;
  for (const core::Problem& problem : problems) codes += problem.code + " " + problem.field + "; ";
  return codes;
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace

TEST_CASE("F05 a scene's own data folders lie inside it", "[hostile_scene][F05]") {
  for (const auto& [name, reason] : std::vector<std::pair<std::string, std::string>>{
           {"..", "it leaves the folder"},
           {"more/../../other", "it leaves the folder"},
           {"/etc", "it is absolute"},
           {"link", "it leaves the folder"},
           {"http://host/data", "it names a URI scheme"}}) {
    const TemporaryFolder folder;
    fs::create_symlink("/etc", folder.path() / "link");
    INFO(name);
    check_problems(folder, "data_folders = [\"" + name + "\"]\n" + tests::kSmallScene,
                   {"@/scene.toml:1:1: E-PATH data_folders = \"" + name +
                    "\": expected a path inside @ (" + reason + ")"});
  }
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "more data");
  folder.write("more data/flight.csv",
               "time_s,latitude_deg,longitude_deg,height_m\n0,52,10,200\n1,52.001,10,200\n");
  const std::string text = "data_folders = [\"none\", \"more data\"]\n" +
                           tests::file_trajectory("vertical_datum = \"scene\"\n");
  CHECK(tests::build_text(folder, text).scene != nullptr);
  check_problems(folder, "data_folders = [" + repeated("\"a\",", 65) + "]\n" + tests::kSmallScene,
                 {"@/scene.toml:1:1: E-LIMIT data_folders = 65: expected at most 64"});
}

TEST_CASE("F05 a material asset beside a model is no link out of the folder",
          "[hostile_scene][F05]") {
  const TemporaryFolder folder;
  folder.write("cube.gltf", R"({"asset": {"version": "2.0"}})");
  fs::create_symlink("/etc/hostname", folder.path() / "cube.xoma");
  const std::string text =
      tests::replaced(tests::kSmallScene, "[weather]",
                      "[[model]]\nfile = \"cube.gltf\"\nopen_material = \"auto\"\nat = "
                      "{ runway = \"36\", behind_threshold_m = 0.0 }\n[weather]");
  check_problems(folder, text,
                 {"@/scene.toml:24:1: E-PATH model[0].open_material = cube.xoma: expected "
                  "a file beside the model, and no link out of its folder"});
  fs::remove(folder.path() / "cube.xoma");
  folder.write("common.xoma", "{}");
  fs::create_symlink("common.xoma", folder.path() / "cube.xoma");
  for (const core::Problem& problem : tests::build_text(folder, text).problems) {
    INFO(core::to_string(problem));
    CHECK(problem.code != "E-PATH");
  }
}

TEST_CASE("R17 more objects than a scene may have are E-LIMIT before any is made",
          "[hostile_scene][R17]") {
  const TemporaryFolder folder;
  check_problems(
      folder, tests::kSmallScene + repeated("[[target]]\n", 10'001),
      {"@/scene.toml:28:3: E-LIMIT target = an array of 10001: expected at most 10000 tables"});
  check_problems(
      folder, tests::kSmallScene + repeated("[[runway]]\n", 64),
      {"@/scene.toml:11:3: E-LIMIT runway = an array of 65: expected at most 64 tables"});
}

TEST_CASE("R17 lines of a million points in all are E-LIMIT", "[hostile_scene][R17]") {
  const std::string line =
      "[[line]]\nfrom = { runway = \"36\", behind_threshold_m = 0.0 }\nto = { runway = \"36\", "
      "behind_threshold_m = 999.0 }\nspacing_m = 0.01\n";
  const TemporaryFolder folder;
  const double begin_s = tests::processor_time_s();
  const tests::PeakMemory memory;
  const tests::Outcome outcome =
      tests::build_text(folder, tests::kSmallScene + repeated(line, 5000));
  INFO(codes_of(outcome.problems));
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems[0].code == "E-LIMIT");
  CHECK(outcome.problems[0].place.line == 28 + 4 * 10);  // the line behind ten of 99 900 points
  CHECK(memory.rise_MiB() < 1500.0);
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
}

TEST_CASE("R17 surfaces over 100 million cells of the ground in all are E-LIMIT",
          "[hostile_scene][R17]") {
  // Each lies on all 250 x 250 cells.
  const std::string surface =
      "[[surface]]\nrunway = \"36\"\nmaterial = \"short_grass\"\n"
      "behind_threshold_m = [-9000.0, 9000.0]\nleft_m = [-9000.0, 9000.0]\n";
  const std::string text =
      tests::replaced(tests::kSmallScene, "spacing_m = 50.0", "spacing_m = 20.0") +
      repeated(surface, 1700);
  const TemporaryFolder folder;
  const double begin_s = tests::processor_time_s();
  const tests::PeakMemory memory;
  const tests::Outcome outcome = tests::build_text(folder, text);
  INFO(codes_of(outcome.problems));
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems[0].code == "E-LIMIT");
  CHECK(outcome.problems[0].field == "surface");
  CHECK(outcome.problems[0].place.line == 28 + 5 * 1600);
  CHECK(memory.rise_MiB() < 500.0 * tests::kSanitizerMemory);
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
}

TEST_CASE("R17 swings of two million waypoints in all are E-LIMIT before any is made",
          "[hostile_scene][R17]") {
  // 5000 swings, which one target may have: 960 000 legs.
  const std::string target =
      "[[target]]\nrcs = { rcs_dBsm = 0.0 }\nswing = { amplitude_m = 0.3, period_s = 0.2 }\n"
      "waypoint = [{ time_s = 0.0, at = { runway = \"36\", behind_threshold_m = 0.0 } },\n"
      "{ time_s = 1000.0, at = { runway = \"36\", behind_threshold_m = 900.0 } }]\n";
  const TemporaryFolder folder;
  const tests::PeakMemory memory;
  const tests::Outcome outcome =
      tests::build_text(folder, tests::kSmallScene + repeated(target, 100));
  INFO(codes_of(outcome.problems));
  REQUIRE(outcome.problems.size() == 1);
  CHECK(outcome.problems[0].code == "E-LIMIT");
  CHECK(outcome.problems[0].field == "target[2].swing");
  CHECK(outcome.problems[0].place.line == 28 + 5 * 2 + 2);
  CHECK(memory.rise_MiB() < 100.0 * tests::kSanitizerMemory);
}

TEST_CASE("R17 models and buildings are counted by the bytes of their files",
          "[hostile_scene][R17]") {
  const TemporaryFolder folder;
  folder.write("large.bin", "");
  fs::resize_file(folder.path() / "large.bin", scenes::kMostBodyFiles_bytes / 2 + 1);
  scenes::FileBudget budget;
  // Counted before it is refused for its own size, which saves reading it.
  CHECK_THROWS_WITH(budget.read(folder.path() / "large.bin", 10),
                    !Catch::Matchers::Contains("all models and buildings"));
  CHECK_THROWS_WITH(budget.read(folder.path() / "large.bin", 10),
                    Catch::Matchers::Contains("E-LIMIT files of all models and buildings"));
  CHECK_NOTHROW(budget.read(folder.write("small.bin", "x"), 10));
}

TEST_CASE("R17 triangles of all boxes and models together are E-LIMIT, and no more is read",
          "[hostile_scene][R17]") {
  const TemporaryFolder folder;
  folder.write("one.gltf",
               R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
               R"({"attributes":{"POSITION":0}}]}],"accessors":[{"componentType":5126,"count":3,)"
               R"("type":"VEC3","bufferView":0}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
               R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAA)"
               R"(AAAAAAAAgD8AAAAA"}]})");
  const std::string model =
      "[[model]]\nfile = \"one.gltf\"\nat = { runway = \"36\", behind_threshold_m = 0.0 }\n";
  folder.write("scene.toml", tests::kSmallScene + repeated(model, 100));
  core::ProblemList problems;
  const scenes::SceneDescription scene =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  const auto library = materials::MaterialLibrary::from_file(scene.material_library, problems);
  const scenes::MaterialNames names(library, problems);
  const terrain::LocalFrame frame(scene.origin, scene.earth);
  const scenes::Ground ground(scene, frame, names, problems);
  scenes::ModelMaterials model_materials(scene, library.size(), problems);
  const auto triangles = [&](std::size_t most) {
    std::size_t sum = 0;
    for (const terrain::PlacedMesh& mesh :
         scenes::build_bodies(scene, ground, names, model_materials, {}, problems, most).meshes)
      sum += mesh.mesh.triangles.size();
    return sum;
  };
  const std::size_t all = triangles(1000);
  CHECK_FALSE(problems.has_errors());
  REQUIRE(all > 100);  // the hangar's, and one for each model
  CHECK(triangles(all) == all);
  CHECK_FALSE(problems.has_errors());
  CHECK(triangles(50) == 51);
  REQUIRE(problems.all().size() == 1);
  CHECK(problems.all()[0].code == "E-LIMIT");
  CHECK(problems.all()[0].place.line == static_cast<int>(28 + 3 * (50 - (all - 100))));
}

TEST_CASE("R17 points of runways, lines and targets together are E-LIMIT, and no more are made",
          "[hostile_scene][R17]") {
  const TemporaryFolder folder;
  const std::string target =
      "[[target]]\nat = { runway = \"36\", behind_threshold_m = 0.0 }\n"
      "rcs = { shape = \"constant\", rcs_dBsm = 0.0 }\n";
  folder.write("scene.toml", tests::kSmallScene + repeated(target, 100));
  core::ProblemList problems;
  const scenes::SceneDescription scene =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  const auto library = materials::MaterialLibrary::from_file(scene.material_library, problems);
  const scenes::MaterialNames names(library, problems);
  const terrain::LocalFrame frame(scene.origin, scene.earth);
  const scenes::Ground ground(scene, frame, names, problems);
  const auto points = [&](std::size_t most) {
    return scenes::build_targets(scene, ground, problems, most).points.size();
  };
  const std::size_t all = points(1000);
  REQUIRE(all > 100);  // the runway's lights, and the targets
  CHECK(points(all) == all);
  CHECK_FALSE(problems.has_errors());
  CHECK(points(all - 50) == all - 49);
  // A hundred targets in one place are warned of too.
  std::vector<core::Problem> errors = problems.all();
  errors.erase(std::remove_if(errors.begin(), errors.end(),
                              [](const core::Problem& problem) { return !problem.is_error(); }),
               errors.end());
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].code == "E-LIMIT");
  CHECK(errors[0].place.line == 28 + 3 * 50);
}

// Two rows with attitudes and a wrong clock kept validate busy for minutes, or hours.
TEST_CASE("A flight of more frames than anybody renders is E-LIMIT, and none is looked at",
          "[hostile_scene]") {
  const TemporaryFolder folder;
  folder.write("t.csv",
               "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n"
               "0,52.0,10.0,160,0,0,0\n1000000,52.001,10.0,160,0,0,0\n");
  const std::string text = tests::kSmallScene.substr(0, tests::kSmallScene.find("[trajectory")) +
                           "[trajectory]\nfile = \"t.csv\"\nvertical_datum = \"scene\"\n";
  const double begin_s = tests::processor_time_s();
  const std::vector<core::Problem> problems = tests::build_text(folder, text).problems;
  CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
  INFO(codes_of(problems));
  const auto found = std::find_if(problems.begin(), problems.end(),
                                  [](const core::Problem& one) { return one.is_error(); });
  REQUIRE(found != problems.end());
  CHECK_THAT(core::to_string(*found), Catch::Matchers::Contains("scene.toml:25:") &&
                                          Catch::Matchers::Contains("E-LIMIT trajectory") &&
                                          Catch::Matchers::Contains("number of frames") &&
                                          Catch::Matchers::Contains("at most 4000000"));
}

TEST_CASE("Scene files of 4 MiB of anything are answered in seconds", "[hostile_scene]") {
  struct Case {
    const char* what;
    std::string text;
    const char* code;
  };
  const Case cases[] = {
      {"keys", filled("", "k#=1\n", ""), "E-REF"},
      {"tables", filled("", "[t#]\n", ""), "E-REF"},
      {"dotted keys", filled("", "a.b.c.d.e.f.g.h#=1\n", ""), "E-REF"},
      {"boxes", filled("", "[[box]]\n", ""), "E-LIMIT"},
      {"models", filled("", "[[model]]\nfile=\"a\"\n", ""), "E-LIMIT"},
      {"data folders", filled("data_folders=[", "\"a\",", "]\n"), "E-LIMIT"},
      {"arrays", filled("a=[", "[],", "]\n"), "E-REF"},
      {"land cover", filled("[terrain]\nland_cover={file=\"x\",classes={", "#=\"a\",", "1=\"b\"}}"),
       "E-PARSE"},
      {"a long text", filled("[scene]\nname=\"", "xxxxxxxx", "\"\n"), "E-REF"},
      {"a long key", filled("", "kkkkkkkk", "=1\n"), "E-REF"},
      {"a long path", filled("object_library=\"", "kkkkkkkk", "\"\n"), "E-"},
      {"quotes", filled("a=\"\"\"", "\"a", "\"\"\"\n"), "E-REF"},
      {"depth", filled("a=", "[", ""), "E-LIMIT"},
      {"a long number", filled("[terrain]\nspacing_m=1", "00000000", "\n"), "E-"},
      {"no UTF-8", filled("[scene]\nname=\"", "\xff", "\"\n"), "E-PARSE"},
      {"nothing", filled("", "\n", ""), "E-REF"}};
  for (const Case& c : cases) {
    const TemporaryFolder folder;
    INFO(c.what);
    const double begin_s = tests::processor_time_s();
    const tests::PeakMemory memory;
    const tests::Outcome outcome = tests::build_text(folder, c.text);
    REQUIRE_FALSE(outcome.problems.empty());
    CHECK(codes_of(outcome.problems).find(c.code) != std::string::npos);
    for (const core::Problem& problem : outcome.problems)
      CHECK(core::to_string(problem).size() < 4000);
    CHECK(memory.rise_MiB() < 512.0 * tests::kSanitizerMemory);
    CHECK(tests::processor_time_s() - begin_s < tests::kAtOnce_s);
  }
}
