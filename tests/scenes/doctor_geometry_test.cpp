// What fanbeam doctor finds in triangles: coordinates that floats do not hold, sizes, duplicates,
// plates in the ground. Each in a scene that has just that, with its figure.
#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/scenes/doctor_scene.h"

using namespace fanbeam;
using tests::box_at;
using tests::check_found;
using tests::checks_of;
using tests::examined;
using tests::Finding;
using tests::Findings;
using tests::found;
using tests::gltf;
using tests::kFarthest_m;
using tests::kPlain;
using tests::model_at;
using tests::north_of_it;
using tests::replaced;
using tests::Severity;
using tests::TemporaryFolder;

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

// Heights count from near the ground in the ray caster: a scene whose zero is the sea has no coarser
// floats in the mountains.
TEST_CASE("T02 ground at 3000 m makes no plate coplanar and no triangle thin", "[doctor]") {
  const TemporaryFolder folder;
  const auto at_height = [&](const std::string& height_m) {
    tests::AsciiGrid{60, 40, 9.94, 51.96, 0.002}.write(folder, "dem",
                                                       [&](int, int) { return height_m; });
    return examined(folder, replaced(kPlain, "half_extent_m = 4000.0",
                                     "half_extent_m = 4000.0\nelevation = \"dem.asc\"") +
                                model_at(100.0, 0.0));
  };
  // 5 mm over the ground: floats of 3000 m have steps of 0.24 mm.
  folder.write("plate.gltf", gltf({-10, 0.005F, -5, 10, 0.005F, -5, 10, 0.005F, 5, -10, 0.005F, 5},
                                  {0, 1, 2, 0, 2, 3}));
  CHECK(checks_of(at_height("0"), Severity::note).empty());
  CHECK(checks_of(at_height("3000"), Severity::note).empty());
  // One centimetre wide.
  folder.write("plate.gltf", gltf({-5, 3, 0, 5, 3, 0, 0, 3, 0.01F}, {0, 1, 2}));
  CHECK(checks_of(at_height("0"), Severity::note).empty());
  CHECK(checks_of(at_height("3000"), Severity::note).empty());
}

TEST_CASE("T08 duplicates are found in any two of many objects, near others or not", "[doctor]") {
  const TemporaryFolder folder;
  const std::string sizes = "length_m = 20\nwidth_m = 20\nheight_m = 10\n";
  const std::string low = "length_m = 20\nwidth_m = 20\nheight_m = 5\n";
  // Another one beside, one that is lower in the same place, and a pair elsewhere.
  const Findings findings =
      examined(folder, kPlain + box_at(1000.0, sizes) + box_at(1010.0, sizes) +
                           box_at(1000.0, low) + box_at(2000.0, low) + box_at(2000.0, low));
  CHECK(checks_of(findings, Severity::note) == std::vector<std::string>{"duplicate-triangles"});
  check_found(findings, "duplicate-triangles", Severity::note, 10.0, "", 0.0);
  const auto last_line = 1 + std::count(kPlain.begin(), kPlain.end(), '\n') + 4 * 6;
  CHECK(findings[0].where.starts_with("scene.toml:" + std::to_string(last_line) + ", box"));
}
