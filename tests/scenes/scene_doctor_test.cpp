// Each thing that fanbeam doctor looks for in ground, flight and points, in a scene that has just
// that, with its figure; and what it says of the shipped scenes.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/constants.h"
#include "tests/scenes/doctor_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;
using tests::box_at;
using tests::check_found;
using tests::checks_of;
using tests::examined;
using tests::Finding;
using tests::Findings;
using tests::found;
using tests::kFarthest_m;
using tests::kPlain;
using tests::north_of_it;
using tests::replaced;
using tests::Severity;
using tests::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

constexpr double kFieldOfView_rad = 41.0 * core::kPi / 180.0;

}  // namespace

TEST_CASE("Nothing is found in a sound scene", "[doctor]") {
  const TemporaryFolder folder;
  CHECK(examined(folder, kPlain).empty());
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
  CHECK(geoid.figure == Approx(45.0).epsilon(0.0).margin(1e-3));
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

TEST_CASE("Targets in each other, by what the second adds", "[doctor]") {
  const TemporaryFolder folder;
  const auto post = [](double above_m) {
    return "[[target]]\nat = " + north_of_it(1000.0) +
           "\nrcs = { rcs_dBsm = 0 }\nabove_ground_m = " + core::number_text(above_m) + "\n";
  };
  check_found(examined(folder, kPlain + post(2) + post(2)), "duplicate-targets", Severity::delicate,
              3.0103, "dB", 1e-4);
  CHECK(examined(folder, kPlain + post(2) + post(3)).empty());
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
  CHECK(found(findings, "target-below-ground").figure == Approx(3.5).epsilon(0.0).margin(0.1));
}

TEST_CASE("A buried line is wrong though another of its name is not", "[doctor]") {
  const TemporaryFolder folder;
  const auto cable = [](const std::string& above_m) {
    return "[[line]]\nname = \"cable\"\nfrom = " + north_of_it(1000.0) +
           "\nto = " + north_of_it(1010.0) + "\nfrom_above_m = " + above_m +
           "\nto_above_m = " + above_m + "\nrcs_dBsm_per_m = -10\nspacing_m = 1\n";
  };
  check_found(examined(folder, kPlain + cable("2") + cable("-3")), "target-below-ground",
              Severity::wrong, 3.0, "m", 1e-9);
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

TEST_CASE("R09 of two wires of one name only the one in long pieces is told", "[doctor]") {
  const TemporaryFolder folder;
  const auto wire = [](const std::string& spacing_m) {
    return "[[line]]\nname = \"wire\"\nmodel = \"wire\"\nfrom = { latitude_deg = 52.01, "
           "longitude_deg = 9.999 }\nto = { latitude_deg = 52.01, longitude_deg = 10.001 }\n"
           "from_above_m = 20\nto_above_m = 20\nspacing_m = " +
           spacing_m + "\n";
  };
  const Findings findings = examined(folder, kPlain + wire("0.5") + wire("5.0"));
  CHECK(checks_of(findings, Severity::delicate) ==
        std::vector<std::string>{"wire-pieces-too-long"});
  const auto second_line = 1 + std::count(kPlain.begin(), kPlain.end(), '\n') + 8;
  CHECK(found(findings, "wire-pieces-too-long")
            .where.find("scene.toml:" + std::to_string(second_line) + ", line \"wire\"") !=
        std::string::npos);
}

TEST_CASE("T13 an antenna low over the ground or in a building", "[doctor]") {
  const TemporaryFolder folder;
  const auto at_height = [&](const std::string& height_m, const std::string& more = "") {
    return examined(
        folder, replaced(kPlain, "above_ground_m = 60.0", "above_ground_m = " + height_m) + more);
  };
  check_found(at_height("1.5"), "antenna-near-ground", Severity::delicate, 1.5, "m", 1e-9);
  CHECK(checks_of(at_height("2.5"), Severity::delicate).empty());
  check_found(at_height("1.5", "[sensor]\nfile = \"hivision.toml\"\ndown_m = 0.5\n"),
              "antenna-near-ground", Severity::delicate, 1.0, "m", 1e-9);
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

TEST_CASE("Nothing is wrong or delicate in the shipped scenes", "[doctor][shipped_scenes]") {
  // Of the shared data; any other scene brings all it needs.
  const std::map<std::string, std::vector<const char*>> data = {
      {"innsbruck-26", {"lowi-innsbruck"}},
      {"innsbruck-26-airliner", {"lowi-innsbruck", "trajectories"}},
      {"keflavik-10", {"bikf-keflavik", "flightgear"}}};
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(fs::path(FANBEAM_SOURCE_DIR) / "scenes"))
    if (fs::exists(entry.path() / "scene.toml")) scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  CHECK(scenes.size() >= 8);
  for (const fs::path& scene : scenes) {
    const std::string name = scene.filename().string();
    INFO(name);
    std::vector<fs::path> folders;
    bool complete = true;
    if (const auto needed = data.find(name); needed != data.end())
      for (const char* each : needed->second) {
        const auto folder = tests::shared_data(each);
        complete = complete && folder.has_value();
        if (folder) folders = {folder->parent_path()};
      }
    if (!complete) continue;
    const tests::Outcome outcome = tests::build(scene, folders);
    REQUIRE(outcome.scene != nullptr);
    CHECK(checks_of(scenes::examine(*outcome.scene, outcome.problems), Severity::delicate).empty());
  }
}
