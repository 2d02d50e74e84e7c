// Each thing that fanbeam doctor looks for, in a scene that has just that, with its figure; and what
// it says of the shipped scenes.
#include "scenes/doctor/scene_doctor.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "tests/scenes/scene_folder.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using scenes::Finding;
using scenes::Findings;
using scenes::Severity;
using tests::replaced;
using tests::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

// 60 m over level grass, looking north; the terrain reaches farther than the radar.
const std::string kPlain = R"([scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
earth = "plane"
[terrain]
half_extent_m = 4000.0
spacing_m = 100.0
[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)";

// Degrees of latitude this far north of the radar: metres of arc on WGS 84 at 52 deg.
std::string north_of_it(double distance_m) {
  return "{ latitude_deg = " + core::number_text(52.0 + distance_m / 111267.0) +
         ", longitude_deg = 10.0 }";
}

constexpr double kFarthest_m = 200.0 + 524 * 6.67;
constexpr double kFieldOfView_rad = 41.0 * core::kPi / 180.0;

// Horizontal triangles: corners (x, z) in metres and their height y, as glTF has its axes.
std::string gltf(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners) {
  std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * 4);
  const std::size_t begin = bytes.size();
  bytes.append(reinterpret_cast<const char*>(positions.data()), positions.size() * 4);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (bytes.size() % 3 != 0) bytes += '\0';
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (const int shift : {18, 12, 6, 0}) base64 += digits[(word >> shift) & 63];
  }
  nlohmann::json document = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"name": "plate",
      "primitives": [{"attributes": {"POSITION": 1}, "indices": 0, "mode": 4}]}],
    "accessors": [{"bufferView": 0, "componentType": 5125, "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5126, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0}, {"buffer": 0}], "buffers": [{}]})");
  document["accessors"][0]["count"] = corners.size();
  document["accessors"][1]["count"] = positions.size() / 3;
  document["bufferViews"][0]["byteLength"] = begin;
  document["bufferViews"][1]["byteOffset"] = begin;
  document["bufferViews"][1]["byteLength"] = positions.size() * 4;
  document["buffers"][0]["byteLength"] = bytes.size();
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  return document.dump();
}

std::string model_at(double north_m, double above_m, const std::string& name = "plate") {
  return "[[model]]\nname = \"" + name + "\"\nfile = \"plate.gltf\"\nat = " + north_of_it(north_m) +
         "\nabove_ground_m = " + core::number_text(above_m) + "\n";
}

std::string box_at(double north_m, const std::string& sizes, const std::string& more = "") {
  return "[[box]]\nname = \"box\"\nat = " + north_of_it(north_m) + "\n" + sizes + more;
}

Findings examined(const TemporaryFolder& folder, const std::string& text) {
  const tests::Outcome outcome = tests::build_text(folder, text);
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  return scenes::examine(*outcome.scene, outcome.problems);
}

std::vector<std::string> checks_of(const Findings& findings, Severity at_least) {
  std::vector<std::string> checks;
  for (const Finding& finding : findings)
    if (finding.severity >= at_least) checks.push_back(finding.check);
  return checks;
}

Finding found(const Findings& findings, const std::string& check) {
  for (const Finding& finding : findings) {
    UNSCOPED_INFO(finding.check << ' ' << finding.figure << ' ' << finding.unit << ' '
                                << finding.where);
    if (finding.check != check) continue;
    CHECK_FALSE(finding.what.empty());
    CHECK_FALSE(finding.where.empty());
    CHECK(finding.why.ends_with('.'));
    CHECK(finding.remedy.ends_with('.'));
    return finding;
  }
  FAIL("no " << check);
  return {};
}

void check_found(const Findings& findings, const std::string& check, Severity severity,
                 double figure, const std::string& unit, double margin) {
  const Finding finding = found(findings, check);
  CHECK(finding.severity == severity);
  CHECK(finding.figure == Approx(figure).margin(margin));
  CHECK(finding.unit == unit);
}

}  // namespace

TEST_CASE("Nothing is found in a sound scene", "[doctor]") {
  const TemporaryFolder folder;
  CHECK(examined(folder, kPlain).empty());
}

TEST_CASE("T01 a scene too far from its origin, by the error of range that floats make",
          "[doctor]") {
  const TemporaryFolder folder;
  const std::string far =
      replaced(replaced(kPlain, "half_extent_m = 4000.0", "half_extent_m = 95000.0"),
               "spacing_m = 100.0", "spacing_m = 1000.0");
  // A float's step at 95 km, over the sine of 60 m seen from the farthest range.
  check_found(
      examined(folder, far + "[[target]]\nat = " + north_of_it(1000.0) +
                           "\nabove_ground_m = 1\nrcs = { shape = \"constant\", rcs_dBsm = 0 }\n"),
      "far-coordinates", Severity::delicate, 95000.0 * 0x1p-23 / (60.0 / kFarthest_m), "m", 1e-3);
}

TEST_CASE("T12 a huge triangle beside tiny ones, by their ratio", "[doctor]") {
  const TemporaryFolder folder;
  folder.write("plate.gltf", gltf({-10000, -40, -10000, 10000, -40, -10000, 0, -40, 10000, 0, 5, 0,
                                   0.001F, 5, 0, 0, 5, 0.001F},
                                  {0, 1, 2, 3, 4, 5}));
  const Findings findings = examined(folder, kPlain + model_at(100.0, 0.0));
  // The longest edge is hypot(10, 20) km.
  check_found(findings, "triangle-sizes", Severity::delicate, std::hypot(1e4, 2e4) / 0.001, "",
              5e5);
  // 0.7 mm high, and floats have steps of some micrometres there: it turns by less than a degree.
  CHECK(checks_of(findings, Severity::note) == std::vector<std::string>{"triangle-sizes"});
}

TEST_CASE("T12 triangles that floats flatten, by the height of the thinnest", "[doctor]") {
  const TemporaryFolder folder;
  folder.write("plate.gltf", gltf({-5, 3, 0, 5, 3, 0, 0, 3, 5, -5, 4, 0, 5, 4, 0, 0, 4, 1e-5F},
                                  {0, 1, 2, 3, 4, 5}));
  // Next to the 25 m2 of the other one it has no area to speak of.
  check_found(examined(folder, kPlain + model_at(3000.0, 0.0)), "thin-triangles", Severity::note,
              1e-5, "m", 1e-7);
}

TEST_CASE("T08 duplicates, by the number of triangles; of other materials they are wrong",
          "[doctor]") {
  const TemporaryFolder folder;
  const std::string sizes = "length_m = 20\nwidth_m = 20\nheight_m = 10\n";
  const std::string metal = "wall = \"metal\"\nroof = \"metal\"\n";
  const std::string brick = "wall = \"brick\"\nroof = \"metal\"\n";
  // Eight triangles of walls and two of the roof; of these the walls differ.
  const Findings same =
      examined(folder, kPlain + box_at(1000.0, sizes, metal) + box_at(1000.0, sizes, metal));
  check_found(same, "duplicate-triangles", Severity::note, 10.0, "", 0.0);
  const Findings different =
      examined(folder, kPlain + box_at(1000.0, sizes, metal) + box_at(1000.0, sizes, brick));
  check_found(different, "duplicate-triangles", Severity::wrong, 10.0, "", 0.0);
  CHECK(found(different, "duplicate-triangles").what.find("8 with another") != std::string::npos);

  folder.write("plate.gltf", gltf({-5, 3, 0, 5, 3, 0, 0, 3, 5}, {0, 1, 2, 0, 0, 1, 1, 1, 1}));
  check_found(examined(folder, kPlain + model_at(1000.0, 0.0)), "degenerate-triangles",
              Severity::note, 2.0, "", 0.0);
}

TEST_CASE("T07 a plate in the plane of the ground is wrong, one that dips into it delicate",
          "[doctor]") {
  const TemporaryFolder folder;
  folder.write("plate.gltf",
               gltf({-10, 0, -5, 10, 0, -5, 10, 0, 5, -10, 0, 5}, {0, 1, 2, 0, 2, 3}));
  check_found(examined(folder, kPlain + model_at(1000.0, 0.0)), "coplanar-overlay", Severity::wrong,
              200.0, "m2", 1e-3);
  CHECK(examined(folder, kPlain + model_at(1000.0, 0.2)).empty());
  folder.write("plate.gltf", gltf({-10, -0.1F, -5, 10, 0.1F, -5, 10, 0.1F, 5, -10, -0.1F, 5},
                                  {0, 1, 2, 0, 2, 3}));
  check_found(examined(folder, kPlain + model_at(1000.0, 0.0)), "overlay-crosses-ground",
              Severity::delicate, 200.0, "m2", 0.1);
}

TEST_CASE("T07 a runway off the terrain, by how many metres and where", "[doctor]") {
  const TemporaryFolder folder;
  tests::AsciiGrid{60, 40, 9.94, 51.96, 0.002}.write(folder, "dem", [](int, int) { return "12"; });
  const auto with_runway = [&](const std::string& first_m, const std::string& second_m) {
    return examined(folder, replaced(kPlain, "half_extent_m = 4000.0",
                                     "half_extent_m = 4000.0\nelevation = \"dem.asc\"") +
                                "[[runway]]\nfirst = { name = \"36\", latitude_deg = 52.0, "
                                "longitude_deg = 10.0, elevation_m = " +
                                first_m +
                                " }\nsecond = { name = \"18\", latitude_deg = 52.018, "
                                "longitude_deg = 10.0, elevation_m = " +
                                second_m + " }\nedge_lights = false\n");
  };
  CHECK(checks_of(with_runway("12", "16"), Severity::delicate).empty());
  check_found(with_runway("12", "19"), "runway-off-terrain", Severity::delicate, 7.0, "m", 1e-3);
  // As heights above the ellipsoid beside heights above the sea would be.
  const Finding geoid = found(with_runway("57", "12"), "runway-off-terrain");
  CHECK(geoid.severity == Severity::wrong);
  CHECK(geoid.figure == Approx(45.0).margin(1e-3));
  CHECK(geoid.where.find("runway 36/18, 0 m east, 0 m north") != std::string::npos);
  CHECK(geoid.remedy.find("vertical datum") != std::string::npos);
}

TEST_CASE("Voids under the field of view, by their area; elsewhere they are nobody's business",
          "[doctor]") {
  const TemporaryFolder folder;
  const std::string text = replaced(kPlain, "half_extent_m = 4000.0",
                                    "half_extent_m = 4000.0\nelevation = \"dem.asc\"\nvoids = "
                                    "\"fill\"");
  const auto with_void_in_row = [&](int void_row) {
    tests::AsciiGrid{60, 40, 9.94, 51.96, 0.002}.write(folder, "dem", [&](int column, int row) {
      return row == void_row && column >= 28 && column < 32 ? "-9999" : "0";
    });
    return examined(folder, text);
  };
  // Four pixels of 0.002 deg, 222.5 m x 137.3 m each, 2.5 pixels (556 m) and more to the north;
  // counted in posts of 100 m x 100 m.
  check_found(with_void_in_row(16), "voids-in-view", Severity::delicate, 4 * 222.5 * 137.3, "m2",
              0.2 * 4 * 222.5 * 137.3);
  CHECK(with_void_in_row(25).empty());  // behind the radar
}

TEST_CASE("Targets below the ground, by their depth", "[doctor]") {
  const TemporaryFolder folder;
  const std::string target = "[[target]]\nname = \"buried\"\nat = " + north_of_it(1000.0) +
                             "\nrcs = { shape = \"constant\", rcs_dBsm = 0 }\nabove_ground_m = ";
  check_found(examined(folder, kPlain + target + "-3\n"), "target-below-ground", Severity::wrong,
              3.0, "m", 1e-9);
  CHECK(examined(folder, kPlain + target + "0.5\n").empty());
  // From 2 m above to 4 m below in six points, the last one in the middle of the last sixth.
  const std::string line = "[[line]]\nname = \"cable\"\nfrom = " + north_of_it(1000.0) +
                           "\nto = " + north_of_it(1005.9) +
                           "\nfrom_above_m = 2\nto_above_m = -4\nrcs_dBsm_per_m = -10\n"
                           "spacing_m = 1.5\n";
  const Findings findings = examined(folder, kPlain + line);
  CHECK(found(findings, "target-below-ground").severity == Severity::delicate);
  CHECK(found(findings, "target-below-ground").figure == Approx(3.5).margin(0.1));
}

TEST_CASE("R09 a pole made of walls, by the part of two rays' distance that it covers",
          "[doctor]") {
  const TemporaryFolder folder;
  const std::string pole = "length_m = 0.3\nwidth_m = 0.3\nheight_m = 10\n";
  // Four sub-columns of a quarter degree.
  const double spacing_rad = kFieldOfView_rad / 164 / 4;
  const double range_m = std::hypot(1500.0, 60.0 - (10.0 - 2.0) / 2.0);
  check_found(examined(folder, kPlain + box_at(1500.0, pole)), "thinner-than-a-ray",
              Severity::delicate, 0.3 / (range_m * spacing_rad), "", 1e-3);
  CHECK(examined(folder, kPlain + box_at(1500.0, "length_m = 5\nwidth_m = 5\nheight_m = 10\n"))
            .empty());
}

TEST_CASE("R09 wires of pieces too long, by the range from which on they are steady", "[doctor]") {
  const TemporaryFolder folder;
  const auto wire = [&](double spacing_m) {
    return examined(folder, kPlain +
                                "[[line]]\nname = \"wire\"\nmodel = \"wire\"\nfrom = { "
                                "latitude_deg = 52.01, longitude_deg = 9.999 }\nto = { "
                                "latitude_deg = 52.01, longitude_deg = 10.001 "
                                "}\nfrom_above_m = 20\nto_above_m = 20\nspacing_m = " +
                                core::number_text(spacing_m) + "\n");
  };
  const double length_m = 0.002 * 68'677.0;  // of arc at 52 deg
  const double piece_m = length_m / std::ceil(length_m / 5.0);
  check_found(wire(5.0), "wire-pieces-too-long", Severity::delicate,
              2.0 * piece_m * piece_m / (299792458.0 / 35e9), "m", 20.0);
  CHECK(checks_of(wire(0.5), Severity::delicate).empty());
}

TEST_CASE("T13 an antenna low over the ground, in it or in a building", "[doctor]") {
  const TemporaryFolder folder;
  const auto at_height = [&](const std::string& height_m, const std::string& more = "") {
    return examined(
        folder, replaced(kPlain, "above_ground_m = 60.0", "above_ground_m = " + height_m) + more);
  };
  check_found(at_height("1.5"), "antenna-near-ground", Severity::delicate, 1.5, "m", 1e-9);
  CHECK(checks_of(at_height("2.5"), Severity::delicate).empty());
  check_found(at_height("1.5", "[sensor]\nfile = \"hivision.toml\"\ndown_m = 2.0\n"),
              "antenna-below-ground", Severity::wrong, 0.5, "m", 1e-9);
  check_found(at_height("60", box_at(0.0, "length_m = 30\nwidth_m = 30\nheight_m = 80\n")),
              "flight-through-building", Severity::wrong, 1.0, "", 0.0);
}

TEST_CASE("Ranges beyond the terrain, by their share of the pictures", "[doctor]") {
  const TemporaryFolder folder;
  double share = 0.0;
  for (int column = 0; column < 164; ++column) {
    const double azimuth_rad = kFieldOfView_rad * ((column + 0.5) / 164 - 0.5);
    share += (kFarthest_m - 2000.0 / std::cos(azimuth_rad)) / (524 * 6.67) / 164;
  }
  check_found(examined(folder, replaced(kPlain, "4000.0", "2000.0")), "beyond-terrain",
              Severity::delicate, 100.0 * share, "%", 0.01);
}

TEST_CASE("Angles that a material's source does not cover are worth a note", "[doctor]") {
  const TemporaryFolder folder;
  const Findings findings = examined(
      folder, replaced(kPlain, "spacing_m = 100.0", "spacing_m = 100.0\nmaterial = \"concrete\""));
  // Known from 20 deg on; at 60 m the nearest cell is seen at 17 deg.
  check_found(findings, "grazing-beyond-source", Severity::note, 100.0, "%", 0.0);
  CHECK(found(findings, "grazing-beyond-source").what.find("concrete (100 %)") !=
        std::string::npos);
}

TEST_CASE("An accuracy below what rounding to grey levels changes cannot be shown", "[doctor]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", kPlain);
  core::ProblemList problems;
  const scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  scenes::BuildOptions options;
  options.accuracy_grey = 0.1;
  const auto scene = scenes::build_scene(description, options, problems);
  check_found(scenes::examine(*scene, problems.all()), "accuracy-below-grey-step",
              Severity::delicate, 1.0 / std::sqrt(12.0), "grey levels", 1e-12);
}

TEST_CASE("Nothing is wrong in the shipped scenes, and what is delicate there is known",
          "[doctor][shipped_scenes]") {
  struct Shipped {
    std::string name;
    std::vector<const char*> data;
    std::vector<std::string> delicate;
  };
  const std::vector<Shipped> shipped = {
      {"flat-grass", {}, {}},
      {"obstacle-field", {}, {}},
      {"braunschweig-26", {}, {}},
      {"rain-94ghz", {}, {}},
      {"innsbruck-26", {"lowi-innsbruck"}, {}},
      {"innsbruck-26-airliner", {"lowi-innsbruck", "trajectories"}, {}},
      {"keflavik-10", {"bikf-keflavik", "flightgear"}, {}}};
  for (const Shipped& each : shipped) {
    std::vector<fs::path> folders;
    bool complete = true;
    for (const char* name : each.data) {
      const auto folder = tests::shared_data(name);
      complete = complete && folder.has_value();
      if (folder) folders = {folder->parent_path()};
    }
    if (!complete) continue;
    const tests::Outcome outcome =
        tests::build(fs::path(FANBEAM_SOURCE_DIR) / "scenes" / each.name, folders);
    REQUIRE(outcome.scene != nullptr);
    const Findings findings = scenes::examine(*outcome.scene, outcome.problems);
    INFO(each.name);
    CHECK(checks_of(findings, Severity::wrong).empty());
    CHECK(checks_of(findings, Severity::delicate) == each.delicate);
  }
}
