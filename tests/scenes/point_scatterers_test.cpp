// What [[target]] and [[line]] become: shapes, typical objects, wires, poles, and what is told
// about them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/files.h"
#include "tests/scenes/built_scene.h"
#include "tests/scenes/problem_checks.h"

using namespace fanbeam;
using tests::kSmallScene;
using tests::TemporaryFolder;

namespace {

const std::string kAt = "at = { runway = \"36\", behind_threshold_m = 100.0 }\n";

std::string target(const std::string& keys) { return "\n[[target]]\n" + kAt + keys + "\n"; }

// A line of 60 m across the runway's axis, or what `to` and `keys` make of it.
std::string line(const std::string& keys, const std::string& to_left_m = "-30.0") {
  return "\n[[line]]\nfrom = { runway = \"36\", behind_threshold_m = 100.0, left_m = 30.0 }\n"
         "to = { runway = \"36\", behind_threshold_m = 100.0, left_m = " +
         to_left_m + " }\n" + keys + "\n";
}

// The targets behind those of the runway, in the small scene without lights.
std::vector<renderer::PointTarget> targets_of(const TemporaryFolder& folder,
                                              const std::string& tables) {
  const std::string dark = tests::replaced(kSmallScene, "elevation_m = 60.0 }\n",
                                           "elevation_m = 60.0 }\nedge_lights = false\n") +
                           tables;
  return tests::good_scene(folder, dark)->world.targets;
}

std::string driving_car(const std::string& first_s, const std::string& last_s) {
  return "\n[[target]]\nname = \"car\"\nrcs = { rcs_dBsm = 10.0 }\n[[target.waypoint]]\ntime_s = " +
         first_s + "\n" + kAt + "[[target.waypoint]]\ntime_s = " + last_s +
         "\nat = { runway = \"36\", behind_threshold_m = 200.0 }\n";
}

std::vector<core::Problem> warnings_of(const TemporaryFolder& folder, const std::string& tables) {
  const tests::Outcome outcome = tests::build_text(folder, kSmallScene + tables);
  REQUIRE(outcome.scene != nullptr);
  return outcome.problems;
}

}  // namespace

TEST_CASE("A target named after a typical object has its cross-section and fluctuation",
          "[targets]") {
  const TemporaryFolder folder;
  const auto targets =
      targets_of(folder, target("rcs = \"person\"") + target("rcs = \"person\"\nswerling = 0") +
                             target("rcs = \"car\"") + target("rcs = \"fence_post\""));
  REQUIRE(targets.size() == 4);
  REQUIRE(std::holds_alternative<materials::ConstantRcs>(targets[0].rcs));
  CHECK(std::get<materials::ConstantRcs>(targets[0].rcs).rcs_m2 ==
        Approx(core::power_from_dB(-1.37)));
  CHECK(targets[0].swerling == core::Swerling::case3);
  CHECK(targets[1].swerling == core::Swerling::steady);
  REQUIRE(std::holds_alternative<materials::LobedRcs>(targets[2].rcs));
  CHECK(std::get<materials::LobedRcs>(targets[2].rcs).lobes.size() == 5);
  CHECK(targets[3].swerling == core::Swerling::steady);
}

TEST_CASE("A car's front points along its heading", "[targets]") {
  const TemporaryFolder folder;
  const auto targets = targets_of(folder, target("rcs = \"car\"\nheading_deg = 90.0"));
  REQUIRE(targets.size() == 1);
  const auto seen_from = [&](const glm::dvec3& direction) {
    return materials::rcs_m2(targets[0].rcs, glm::transpose(targets[0].axes) * direction, 0.0086);
  };
  // At 10 deg up: front (east) below a side (north or south).
  const double up = std::sin(core::radians(10.0));
  const double level = std::cos(core::radians(10.0));
  CHECK(seen_from({0.0, level, up}) == Approx(core::power_from_dB(20.75)).epsilon(1e-3));
  CHECK(seen_from({0.0, -level, up}) == Approx(core::power_from_dB(20.75)).epsilon(1e-3));
  CHECK(seen_from({level, 0.0, up}) == Approx(core::power_from_dB(15.52 - 0.96)).epsilon(0.01));
  CHECK(seen_from({-level, 0.0, up}) == Approx(core::power_from_dB(14.56)).epsilon(1e-3));
}

TEST_CASE("All shapes of a target are read with their sizes", "[targets]") {
  const TemporaryFolder folder;
  const auto targets =
      targets_of(folder, target("rcs = { shape = \"sphere\", radius_m = 0.2 }") +
                             target("rcs = { shape = \"square_trihedral\", edge_m = 0.3 }") +
                             target("rcs = { shape = \"wire\", radius_m = 0.02, length_m = 2.0, "
                                    "polarisation_deg = 90.0, coherence_length_m = 0.5 }") +
                             target("rcs = { shape = \"wire\", length_m = 1.5 }"));
  REQUIRE(targets.size() == 4);
  CHECK(std::get<materials::Sphere>(targets[0].rcs).radius_m == 0.2);
  CHECK(std::get<materials::SquareTrihedral>(targets[1].rcs).edge_m == 0.3);
  const auto wire = std::get<materials::RoundWire>(targets[2].rcs);
  CHECK(wire.radius_m == 0.02);
  CHECK(wire.length_m == 2.0);
  CHECK(wire.polarisation_rad == Approx(core::kPi / 2.0));
  CHECK(wire.coherence_length_m == 0.5);
  CHECK(std::get<materials::RoundWire>(targets[3].rcs).coherence_length_m == 1.5);
}

TEST_CASE("A pole is a line from a place to the same place with two heights", "[targets]") {
  const TemporaryFolder folder;
  const auto targets = targets_of(
      folder, line("from_above_m = 1.0\nto_above_m = 13.0\nrcs_dBsm_per_m = 3.0", "30.0"));
  REQUIRE(targets.size() == 12);
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const glm::dvec3 at_m = targets[i].path.front().position_m;
    CHECK(at_m.x == Approx(targets[0].path.front().position_m.x).epsilon(0.0).margin(1e-9));
    CHECK(at_m.z - targets[0].path.front().position_m.z ==
          Approx(static_cast<double>(i)).epsilon(0.0).margin(1e-6));
    sum_m2 += std::get<materials::ConstantRcs>(targets[i].rcs).rcs_m2;
  }
  CHECK(sum_m2 == Approx(12.0 * core::power_from_dB(3.0)));
}

TEST_CASE("A line of objects has one at every point", "[targets]") {
  const TemporaryFolder folder;
  const auto targets = targets_of(folder, line("object = \"fence_post\"\nspacing_m = 3.0"));
  REQUIRE(targets.size() == 20);
  for (const renderer::PointTarget& post : targets)
    CHECK(std::get<materials::ConstantRcs>(post.rcs).rcs_m2 == Approx(core::power_from_dB(1.13)));
  CHECK(targets_of(folder, line("object = \"person\""))[0].swerling == core::Swerling::case3);
}

TEST_CASE("A wire's pieces lie along it, share its length and know the radar's polarisation",
          "[targets]") {
  const TemporaryFolder folder;
  const auto across = targets_of(folder, line("model = \"wire\"\nradius_m = 0.0125\n"
                                              "from_above_m = 20.0\nto_above_m = 20.0"));
  REQUIRE(across.size() == 120);
  const auto piece = std::get<materials::RoundWire>(across[7].rcs);
  CHECK(piece.radius_m == 0.0125);
  CHECK(piece.length_m == Approx(0.5).epsilon(1e-4));
  CHECK(piece.coherence_length_m == 0.0);
  // Horizontal field along a level wire.
  CHECK(piece.polarisation_rad == Approx(0.0).epsilon(0.0).margin(1e-3));
  CHECK(std::abs(across[7].axes[2].x) == Approx(1.0).epsilon(1e-4));
  CHECK(glm::determinant(across[7].axes) == Approx(1.0));

  const auto upright = targets_of(folder, line("model = \"wire\"\nto_above_m = 10.0\n"
                                               "coherence_length_m = 0.2",
                                               "30.0"));
  REQUIRE(upright.size() == 20);
  const auto pole = std::get<materials::RoundWire>(upright[0].rcs);
  CHECK(pole.polarisation_rad == Approx(core::kPi / 2.0).epsilon(1e-6));
  CHECK(pole.coherence_length_m == 0.2);
  const auto stated =
      targets_of(folder, line("model = \"wire\"\npolarisation_deg = 45.0", "-30.0"));
  CHECK(std::get<materials::RoundWire>(stated[0].rcs).polarisation_rad == Approx(core::kPi / 4.0));
}

TEST_CASE("A thin wire is the same as a target and as a line, for both polarisations",
          "[targets]") {
  const TemporaryFolder folder;
  folder.write(
      "vertical.toml",
      tests::replaced(core::read_file(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", 1U << 20U),
                      "polarisation = \"HH\"", "polarisation = \"VV\""));
  const std::string same_place =
      "to_above_m = 1.0\nmodel = \"wire\"\nradius_m = 0.00015\n"
      "spacing_m = 1.0";
  const std::string thin = "above_ground_m = 0.5\nrcs = { shape = \"wire\", radius_m = 0.00015 }";
  const auto rcs_dBsm = [](const renderer::PointTarget& wire, const glm::dvec3& direction) {
    return 10.0 * std::log10(materials::rcs_m2(wire.rcs, glm::transpose(wire.axes) * direction,
                                               core::kSpeedOfLight_mps / 35e9));
  };
  const std::string vertical_sensor =
      "[sensor]\nfile = \"vertical.toml\"\n[materials]\nallow_extrapolation = true\n";
  double level_dBsm[2];
  for (const bool vertical : {false, true}) {
    const auto wires =
        targets_of(folder, target(thin) + target(thin + "\ntilt_deg = 90.0\nheading_deg = 90.0") +
                               line(same_place, "30.0") + (vertical ? vertical_sensor : ""));
    REQUIRE(wires.size() == 3);  // the line first
    for (const glm::dvec3& direction : {glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(0.0, -1.0, 0.003)})
      CHECK(rcs_dBsm(wires[1], direction) ==
            Approx(rcs_dBsm(wires[0], direction)).epsilon(0.0).margin(1e-3));
    level_dBsm[vertical ? 1 : 0] = rcs_dBsm(wires[1], {0.0, -1.0, 0.0});
    // Boresight to the sky: the wire lies level.
    const auto level = std::get<materials::RoundWire>(wires[2].rcs);
    CHECK(level.polarisation_rad ==
          Approx(vertical ? core::kPi / 2.0 : 0.0).epsilon(0.0).margin(1e-9));
  }
  // ka = 0.11: a field across such a wire hardly sees it.
  CHECK(level_dBsm[1] - level_dBsm[0] > 20.0);
}

TEST_CASE("Wrong names and keys of point scatterers", "[targets][bad_scene]") {
  const TemporaryFolder folder;
  const auto problems = [&](const std::string& tables) {
    std::vector<std::string> found;
    for (const core::Problem& problem : tests::build_text(folder, kSmallScene + tables).problems)
      found.push_back(problem.code + " " + problem.field + " = " + problem.value + ": " +
                      problem.expected);
    return found;
  };
  using Expected = std::vector<std::string>;
  CHECK(problems(target("rcs = \"cr\"")) ==
        Expected{"E-REF target[0].rcs = \"cr\": an object of the library; nearest are car, cart, "
                 "bus"});
  CHECK(problems(target("rcs = 3.0")) == Expected{"E-PARSE target[0].rcs = 3: a table"});
  CHECK(problems(target("")).size() == 1);
  CHECK(
      problems(target("rcs = { shape = \"ball\" }"))[0].starts_with("E-RANGE target[0].rcs.shape"));
  CHECK(problems(line("object = \"fencepost\""))[0].starts_with(
      "E-REF line[0].object = \"fencepost\": an object of the library; nearest are fence_post"));
  // Keys of another model are unknown to this one.
  CHECK(problems(line("object = \"fence_post\"\nrcs_dBsm_per_m = 3.0"))[0].starts_with(
      "E-REF line[0].rcs_dBsm_per_m"));
  CHECK(problems(line("radius_m = 0.01"))[0].starts_with("E-REF line[0].radius_m"));
  CHECK(problems(line("model = \"wire\"\nradius_m = -0.01"))[0].starts_with(
      "E-RANGE line[0].radius_m"));
  CHECK(problems("object_library = \"none.toml\"\n").empty() == false);
}

TEST_CASE("A target moves on the flight's clock, in Unix time too, and one that never does is told",
          "[targets]") {
  const TemporaryFolder folder;
  std::string rows = "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  for (const char* row : {"0,52.0000", "1,52.0005", "2,52.0010", "3,52.0015", "4,52.0020"})
    rows += "171593460" + std::string(row) + ",10,200,0,0,0\n";
  folder.write("flight.csv", rows);
  const std::string flight = tests::file_trajectory("vertical_datum = \"scene\"\n");
  const auto built = [&](const std::string& first_s, const std::string& last_s) {
    tests::Outcome outcome = tests::build_text(folder, flight + driving_car(first_s, last_s));
    for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
    REQUIRE(outcome.scene != nullptr);
    std::erase_if(outcome.problems,
                  [](const core::Problem& problem) { return problem.code != "W-STANDS"; });
    return outcome;
  };
  const tests::Outcome moving = built("1715934600", "1715934604");
  CHECK(moving.problems.empty());
  const auto& targets = moving.scene->world.targets;
  const auto car = std::find_if(targets.begin(), targets.end(),
                                [](const auto& target) { return target.name == "car"; });
  REQUIRE(car != targets.end());
  CHECK(car->position_at(1715934602.0).y == Approx(150.0).epsilon(0.0).margin(1e-3));
  CHECK(built("1715934603.9", "1715934610").problems.empty());

  const tests::Outcome standing = built("0", "4");
  REQUIRE(standing.problems.size() == 1);
  CHECK(standing.problems[0].place.line > 0);
  CHECK(standing.problems[0].value == "\"car\" on its way from 0 s to 4 s");
  CHECK_THAT(standing.problems[0].expected,
             Catch::EndsWith("on the same clock, is from 1715934600 s to 1715934604 s"));
  CHECK(built("1715934604", "1715934610").problems.size() == 1);
}

TEST_CASE("Times of waypoints that are no times are told alone, not their order too",
          "[targets][bad_scene]") {
  const auto told = [](const std::string& first_s, const std::string& last_s) {
    const TemporaryFolder folder;
    std::vector<std::string> found;
    for (const core::Problem& problem :
         tests::build_text(folder, kSmallScene + driving_car(first_s, last_s)).problems)
      found.push_back(problem.code + " " + problem.field);
    return found;
  };
  using Found = std::vector<std::string>;
  CHECK(told("-2e10", "-1.5e10") ==
        Found{"E-RANGE target[0].waypoint[0].time_s", "E-RANGE target[0].waypoint[1].time_s"});
  CHECK(told("3.0", "nan") == Found{"E-NONFINITE target[0].waypoint[1].time_s"});
  CHECK(told("3.0", "3.0") == Found{"E-TIME target[0].waypoint[1].time_s"});
}

TEST_CASE("A bad waypoint of a target that swings is told with its line", "[targets][bad_scene]") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& second_at) {
    const std::string text =
        kSmallScene +
        "\n[[target]]\nrcs = { rcs_dBsm = 10.0 }\n"
        "swing = { amplitude_m = 0.3, period_s = 1.0 }\n"
        "[[target.waypoint]]\ntime_s = 0.0\n" +
        kAt + "[[target.waypoint]]\ntime_s = 9.0\nat = { runway = " + second_at + " }\n";
    const tests::Outcome outcome = tests::build_text(folder, text);
    REQUIRE(outcome.problems.size() == 1);
    CHECK(outcome.problems[0].place.line == std::count(text.begin(), text.end(), '\n'));
    return outcome.problems[0].code + " " + outcome.problems[0].field;
  };
  CHECK(told("\"36\", behind_threshold_m = 100.0, left_m = 2600.0") ==
        "E-RANGE target[0].waypoint[1].at");
  CHECK(told("\"09\", behind_threshold_m = 100.0") == "E-REF target[0].waypoint[1].at.runway");
}

// Signals refused it later, without the target and its line.
TEST_CASE("A target faster than signals take is told with its line", "[targets][bad_scene]") {
  const TemporaryFolder folder;
  const auto text = [](const std::string& later_s) {
    return kSmallScene + "\n[[target]]\nname = \"comet\"\nrcs = { rcs_dBsm = 10.0 }\n" +
           "[[target.waypoint]]\ntime_s = 0.0\n" + kAt +
           "[[target.waypoint]]\ntime_s = " + later_s +
           "\nat = { runway = \"36\", behind_threshold_m = 300.0 }\n";
  };
  const tests::Outcome outcome = tests::build_text(folder, text("0.002"));
  REQUIRE(outcome.problems.size() == 1);
  CHECK_THAT(core::to_string(outcome.problems[0]),
             Catch::Contains("scene.toml:29:1: E-RANGE target = \"comet\" at 1000") &&
                 Catch::Contains(" m/s from waypoint 0 to 1: expected at most 50000 m/s"));
  CHECK(tests::build_text(folder, text("0.0041")).scene != nullptr);
}

TEST_CASE("A scene may bring objects of its own", "[targets]") {
  const TemporaryFolder folder;
  folder.write("mine.toml", R"([windsock]
rcs_dBsm = 3.0
spread_dB = 2.0
fluctuation = 1
frequency_range_GHz = [10, 100]
size_m = [3.0, 0.6, 6.0]
confidence = "assumed"
source = "a test"
)");
  const std::string text =
      "object_library = \"mine.toml\"\n" + kSmallScene + target("rcs = \"windsock\"");
  const auto scene = tests::good_scene(folder, text);
  const renderer::PointTarget& windsock = scene->world.targets.back();
  CHECK(std::get<materials::ConstantRcs>(windsock.rcs).rcs_m2 == Approx(core::power_from_dB(3.0)));
  CHECK(windsock.swerling == core::Swerling::case1);
  CHECK(scene->description.files.back().filename() == "mine.toml");
}

TEST_CASE("Targets in each other are told by both names, once for two objects", "[targets]") {
  const TemporaryFolder folder;
  const std::string mast = target("name = \"mast\"\nrcs = { rcs_dBsm = 10.0 }");
  const auto mast_line = 2 + std::count(kSmallScene.begin(), kSmallScene.end(), '\n');
  const auto beside_mast = [&](const std::string& keys) {
    return warnings_of(folder, mast + target("name = \"twin\"\n" + keys));
  };
  const auto twins = beside_mast("rcs = { rcs_dBsm = 10.0 }\nheading_deg = 30.0");
  REQUIRE(twins.size() == 1);
  CHECK(twins[0].code == "W-DUPLICATE");
  CHECK(twins[0].field == "target");
  CHECK(twins[0].place.line == mast_line + 5);
  CHECK(twins[0].value == "\"twin\" at the place of \"mast\" of line " + std::to_string(mast_line) +
                              ", with the same RCS");
  CHECK(twins[0].expected == "both are kept, and two echo 3 dB more than one");
  CHECK(beside_mast("rcs = { rcs_dBsm = 10.01 }").empty());
  CHECK(beside_mast("rcs = { rcs_dBsm = 10.0 }\nabove_ground_m = 0.01").empty());

  // The same place from its latitude and longitude, rounded as files do.
  const auto scene = tests::good_scene(folder, kSmallScene + mast);
  const core::Geodetic at =
      scene->frame.to_geodetic(scene->world.targets.back().path.front().position_m);
  char spot[80];
  std::snprintf(spot, sizeof spot, "at = { latitude_deg = %.11f, longitude_deg = %.11f }\n",
                core::degrees(at.latitude_rad), core::degrees(at.longitude_rad));
  CHECK(
      warnings_of(folder, mast + "\n[[target]]\n" + spot + "rcs = { rcs_dBsm = 10.0 }\n").size() ==
      1);

  // A trihedral looks one way.
  const auto corners = [&](const std::string& heading_deg) {
    const std::string corner = "rcs = { shape = \"trihedral\", edge_m = 0.1 }\nheading_deg = ";
    return warnings_of(folder, target(corner + "0.0") + target(corner + heading_deg));
  };
  CHECK(corners("180.0").empty());
  CHECK(corners("360.0").size() == 1);

  const std::string poles = line("object = \"fence_post\"");
  const auto lines = warnings_of(folder, poles + poles);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].field == "line");
  CHECK(lines[0].value.starts_with("20 of the 20 points of \"line\" at the place of \"line\""));

  // Cars that start together and part are two cars.
  const auto drive = [](const std::string& left_m) {
    return "\n[[target]]\nrcs = { rcs_dBsm = 10.0 }\n"
           "[[target.waypoint]]\ntime_s = 0.0\n" +
           kAt +
           "[[target.waypoint]]\ntime_s = 9.0\nat = { runway = \"36\", behind_threshold_m = 200.0, "
           "left_m = " +
           left_m + " }\n";
  };
  CHECK(warnings_of(folder, drive("0.0") + drive("5.0")).empty());
  CHECK(warnings_of(folder, drive("5.0") + drive("5.0")).size() == 1);
}

TEST_CASE("Targets too large for the far field are counted in one warning", "[targets]") {
  const TemporaryFolder folder;
  CHECK(warnings_of(folder, target("rcs = { shape = \"trihedral\", edge_m = 1.0 }")).empty());
  const auto warnings =
      warnings_of(folder, target("name = \"gate\"\nrcs = { shape = \"plate\", width_m = 4.0, "
                                 "height_m = 3.0 }") +
                              target("rcs = { shape = \"cylinder\", length_m = 12.0 }") +
                              line("model = \"wire\"\nspacing_m = 10.0"));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].code == "W-NEAR-FIELD");
  // 60 m in pieces of 10 m: 2 x 100 m2 / 8.57 mm. Lines are looked at first.
  CHECK(warnings[0].field == "target 'line', far field");
  CHECK(warnings[0].value == "from 23349 m");
  CHECK(warnings[0].expected.find("an upper bound") != std::string::npos);
  CHECK(warnings[0].expected.find("(2 more such targets)") != std::string::npos);
  CHECK(warnings[0].place.line > 0);
}

TEST_CASE("An object not known at the sensor's frequency is told about once", "[targets]") {
  const TemporaryFolder folder;
  const auto warnings = warnings_of(
      folder, target("rcs = \"airliner\"") + target("rcs = \"airliner\"\nabove_ground_m = 30.0"));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].code == "W-EXTRAPOLATED");
  CHECK(warnings[0].field == "object 'airliner' at frequency_GHz");
}
