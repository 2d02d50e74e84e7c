// Scenes made from public data: what is guessed of elevations, flights and buildings, and that the
// scene that comes of it can be built.
#include "scenes/new_scene/new_scene.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/text.h"
#include "core/units.h"
#include "scenes/new_scene/buildings_guess.h"
#include "scenes/new_scene/elevation_guess.h"
#include "scenes/new_scene/words.h"
#include "scenes/scene.h"
#include "terrain/geoid.h"
#include "tests/scenes/problem_text.h"
#include "tests/scenes/scene_folder.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using namespace fanbeam::scenes;
using Catch::Contains;
using core::VerticalDatum;
using tests::all_of;
using Heights = terrain::RasterFacts::Heights;

namespace {

std::string listed(const Notes& notes) {
  std::string text;
  for (const Note& note : notes)
    text += (note.guess ? "? " : "  ") + note.label + ": " + note.text + "\n";
  return text;
}

terrain::RasterFacts facts(const char* format, Heights heights, const char* name) {
  return {format, heights, name, {}};
}

// Ten kilometres around 52 N 10 E in 100 m cells, whole metres, a plain that rises to the north.
std::filesystem::path plain(const tests::TemporaryFolder& folder, double level_m = 80.0,
                            double half_extent_deg = 0.1) {
  tests::AsciiGrid grid;
  grid.cell = 0.001;
  grid.columns = grid.rows = static_cast<int>(2 * half_extent_deg / grid.cell);
  grid.west = 10.0 - half_extent_deg;
  grid.south = 52.0 - half_extent_deg;
  return grid.write(folder, "dem", [&](int, int row) {
    return std::to_string(static_cast<int>(level_m + 0.1 * (grid.rows / 2 - row)));
  });
}

// 2000 m due north from 52 N 10 E, 80 m above mean sea level.
Airport airport(std::optional<double> elevation_m = 80.0) {
  AirportRunway runway;
  runway.ends[0].name = "36";
  runway.ends[0].pavement_end = {core::radians(52.0), core::radians(10.0), 0.0};
  runway.ends[0].elevation_m = elevation_m;
  runway.ends[1].name = "18";
  runway.ends[1].pavement_end = {core::radians(52.018), core::radians(10.0), 0.0};
  runway.ends[1].elevation_m = elevation_m;
  runway.surface = surface_of_text("ASP");
  Airport result;
  result.ident = "ZZZZ";
  result.name = "Some \"Field\"\nin = \"injected\"";
  result.runways.push_back(runway);
  return result;
}

NewSceneRequest request(const std::filesystem::path& elevation,
                        std::optional<double> elevation_m = 80.0) {
  NewSceneRequest wanted;
  wanted.name = "zzzz-36";
  wanted.airport = airport(elevation_m);
  wanted.airport_source = "runways.csv";
  wanted.runway = "36";
  wanted.elevation = elevation;
  return wanted;
}

// Copies what the scene names and builds it.
tests::Outcome built(const tests::TemporaryFolder& folder, const NewScene& scene) {
  for (const NewSceneFile& file : scene.files) {
    std::filesystem::create_directories((folder.path() / file.name).parent_path());
    std::filesystem::copy_file(file.from, folder.path() / file.name);
  }
  folder.write("scene.toml", scene.text);
  return tests::build(folder.path());
}

// A square of 20 m x 33 m.
std::string square_with(const std::string& properties, double east_deg) {
  const std::string x = std::to_string(east_deg), x2 = std::to_string(east_deg + 0.0003);
  return R"({"type":"Feature","properties":{)" + properties +
         R"(},"geometry":{"type":"Polygon","coordinates":[[[)" + x + ",52.01],[" + x2 +
         ",52.01],[" + x2 + ",52.0103],[" + x + ",52.0103],[" + x + ",52.01]]]}}";
}

BuildingsGuess guessed_of(const std::string& features, Notes& notes) {
  const tests::TemporaryFolder folder;
  const auto file =
      folder.write("b.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  core::ProblemList problems;
  const auto guess = guess_buildings(file, notes, problems);
  INFO(all_of(problems));
  REQUIRE(guess.has_value());
  return *guess;
}

}  // namespace

TEST_CASE("What a file says of its heights counts, and published elevations may contradict it",
          "[new-scene]") {
  const double geoid_m = 47.6;  // Friedrichshafen
  const auto srtm = guess_datum(facts("SRTMHGT", Heights::gravity, "EGM96"), {-1.2, 0.8}, geoid_m);
  CHECK(srtm.datum == VerticalDatum::egm96);
  CHECK_FALSE(srtm.assumed);
  CHECK_FALSE(srtm.doubtful);
  const auto ellipsoid =
      guess_datum(facts("GTiff", Heights::ellipsoid, "WGS 84"), {47.0, 48.5}, geoid_m);
  CHECK(ellipsoid.datum == VerticalDatum::ellipsoid);
  CHECK_FALSE(ellipsoid.doubtful);
  const auto lie = guess_datum(facts("GTiff", Heights::ellipsoid, "WGS 84"), {0.5, 1.0}, geoid_m);
  CHECK(lie.datum == VerticalDatum::ellipsoid);
  CHECK(lie.doubtful);
  const auto other = guess_datum(facts("GTiff", Heights::gravity, "EGM2008 height"), {}, geoid_m);
  CHECK(other.datum == VerticalDatum::egm96);
  CHECK_THAT(other.why, Contains("EGM2008 height"));
}

TEST_CASE("Of a file that says nothing the published elevations tell the datum, where they can",
          "[new-scene]") {
  const terrain::RasterFacts silent = facts("GTiff", Heights::unsaid, "");
  const auto sea = guess_datum(silent, {2.0, -3.0, 1.0}, 47.6);
  CHECK(sea.datum == VerticalDatum::egm96);
  CHECK_FALSE(sea.assumed);
  // One end with a wrong elevation does not decide.
  const auto ellipsoid = guess_datum(silent, {46.0, 49.0, 0.0}, 47.6);
  CHECK(ellipsoid.datum == VerticalDatum::ellipsoid);
  const auto below = guess_datum(silent, {-29.0, -31.0}, -30.0);  // geoid below the ellipsoid
  CHECK(below.datum == VerticalDatum::ellipsoid);
  for (const auto& unclear : {guess_datum(silent, {}, 47.6), guess_datum(silent, {3.0}, 5.0),
                              guess_datum(silent, {120.0}, 47.6)}) {
    CHECK(unclear.datum == VerticalDatum::egm96);
    CHECK(unclear.assumed);
  }
}

TEST_CASE("A scene of generated data says all that was guessed, and can be built", "[new-scene]") {
  const tests::TemporaryFolder data, folder;
  core::ProblemList problems;
  const auto scene = make_new_scene(request(plain(data)), problems);
  INFO(all_of(problems));
  REQUIRE(scene.has_value());
  INFO(scene->text);
  CHECK_THAT(listed(scene->notes),
             Contains("vertical datum: egm96: the file does not say") && Contains("whole metres"));
  CHECK(scene->files.size() == 2);  // the grid and its .prj
  CHECK_THAT(scene->text, Contains("quantisation_step_m = 1.0") &&
                              Contains("elevation = \"terrain/dem.asc\"") &&
                              Contains("surface = \"asphalt_worn\""));
  const tests::Outcome outcome = built(folder, *scene);
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  CHECK(outcome.problems.empty());
  CHECK(outcome.scene->description.name == "zzzz-36");
  // What an airport is called stays one line of text, whatever is in it.
  CHECK(outcome.scene->description.title == "ZZZZ runway 36, Some \"Field\"\\x0ain = \"injected\"");
  // 5 km and the flare at 70 m/s.
  CHECK(outcome.scene->trajectory->end_s() - outcome.scene->trajectory->begin_s() ==
        Approx(5300.0 / 70.0).epsilon(0.05));
}

TEST_CASE("Elevations that are not published come from the terrain, and that is told",
          "[new-scene]") {
  const tests::TemporaryFolder data, folder;
  core::ProblemList problems;
  const auto scene = make_new_scene(request(plain(data, 130.0), std::nullopt), problems);
  INFO(all_of(problems));
  REQUIRE(scene.has_value());
  INFO(scene->text << listed(scene->notes));
  CHECK_THAT(listed(scene->notes), Contains("? vertical datum: egm96: assumed") &&
                                       Contains("? elevation of 36: 130.") &&
                                       Contains("m, from the terrain"));
  const tests::Outcome outcome = built(folder, *scene);
  REQUIRE(outcome.scene != nullptr);
  CHECK(outcome.scene->description.runways[0].ends[0].pavement_end.height_m ==
        Approx(130.0).epsilon(0.0).margin(0.5));
  CHECK(outcome.scene->description.runways[0].ends[1].pavement_end.height_m ==
        Approx(131.8).epsilon(0.0).margin(1.0));
}

TEST_CASE("Terrain above the ellipsoid takes the runway's published elevations with it",
          "[new-scene]") {
  const tests::TemporaryFolder data, folder;
  core::ProblemList problems;
  const double geoid_m = terrain::egm96_geoid_height_m(core::radians(52.0), core::radians(10.0));
  REQUIRE(geoid_m > 40.0);
  const auto scene = make_new_scene(request(plain(data, 80.0 + geoid_m)), problems);
  REQUIRE(scene.has_value());
  INFO(scene->text << listed(scene->notes));
  CHECK_THAT(scene->text, Contains("vertical_datum = \"ellipsoid\""));
  const tests::Outcome outcome = built(folder, *scene);
  REQUIRE(outcome.scene != nullptr);
  CHECK(outcome.scene->description.runways[0].ends[0].pavement_end.height_m ==
        Approx(80.0 + geoid_m).epsilon(0.0).margin(0.01));
}

TEST_CASE("Everything wrong with the data of a new scene is told at once", "[new-scene]") {
  const tests::TemporaryFolder data;
  const auto told = [](const NewSceneRequest& wanted) {
    core::ProblemList problems;
    CHECK_FALSE(make_new_scene(wanted, problems).has_value());
    return all_of(problems);
  };
  NewSceneRequest wrong = request("/nowhere/dem.tif");
  wrong.runway = "09";
  wrong.buildings = data.write("b.geojson", "no json");
  const std::string text = told(wrong);
  CHECK_THAT(text, Contains("E-IO raster") && Contains("E-REF runway = \"09\"") &&
                       Contains("E-PARSE GeoJSON"));

  SECTION("an approach that begins beyond the elevation data") {
    const std::string missing = told(request(plain(data, 80.0, 0.03)));
    CHECK_THAT(missing, Contains("E-RANGE elevation data = 51.97 to 52.03 N, 9.97 to 10.03 E") &&
                            Contains("all of 51.95 to 52.02 N") && Contains("--start-distance"));
    NewSceneRequest shorter = request(plain(data, 80.0, 0.03));
    shorter.start_distance_m = 2000.0;
    core::ProblemList problems;
    CHECK(make_new_scene(shorter, problems).has_value());
  }
  SECTION("a runway whose latitudes and longitudes are exchanged") {
    NewSceneRequest exchanged = request(plain(data));
    for (AirportRunwayEnd& end : exchanged.airport->runways[0].ends)
      std::swap(end.pavement_end.latitude_rad, end.pavement_end.longitude_rad);
    exchanged.airport->runways[0].ends[0].name = "09";
    exchanged.airport->runways[0].ends[1].name = "27";
    exchanged.runway = "09";
    CHECK_THAT(told(exchanged), Contains("latitude and longitude exchanged"));
  }
}

TEST_CASE("Posts without a height are filled in a new scene", "[new-scene]") {
  const tests::TemporaryFolder data, folder;
  tests::AsciiGrid grid;
  grid.cell = 0.001;
  grid.columns = grid.rows = 200;
  grid.west = 9.9;
  grid.south = 51.9;
  const auto file = grid.write(data, "dem", [](int column, int row) {
    return std::string(column == 60 && row == 60 ? "-9999" : "80.25");
  });
  core::ProblemList problems;
  const auto scene = make_new_scene(request(file), problems);
  REQUIRE(scene.has_value());
  CHECK_THAT(scene->text, Contains("voids = \"fill\"") && !Contains("quantisation_step_m"));
  CHECK_THAT(listed(scene->notes), Contains("1 without a height"));
  CHECK(built(folder, *scene).scene != nullptr);
}

TEST_CASE("The height property of buildings is the one that most features have as a number",
          "[new-scene]") {
  Notes notes;
  const auto some =
      guessed_of(square_with(R"("building:height":12,"height":"12 m")", 10.0) + "," +
                     square_with(R"("building:height":9.5,"building:levels":3)", 10.001),
                 notes);
  CHECK(some.height_property == "building:height");
  CHECK_THAT(listed(notes), Contains("2 footprints, heights from \"building:height\""));
  notes.clear();
  const auto measured = guessed_of(
      square_with(R"("measuredHeight":12)", 10.0) + "," + square_with(R"("name":"shed")", 10.001),
      notes);
  CHECK(measured.height_property == "measuredHeight");
  CHECK_THAT(listed(notes), Contains("of 1 without it 5 m"));
  notes.clear();
  CHECK(guessed_of(square_with(R"("name":"shed")", 10.0), notes).height_property.empty());
  CHECK_THAT(listed(notes), Contains("? buildings") && Contains("5 m each"));
}

// "MIN_HEIGHT" of massing from lidar is the lowest point of the roof: all buildings floated at it.
TEST_CASE("The underside of buildings is the property named like their height, if most stand by it",
          "[new-scene]") {
  const auto underside = [](const std::string& raised, const std::string& standing, Notes& notes) {
    return guessed_of(square_with(raised, 10.0) + "," + square_with(standing, 10.001), notes)
        .min_height_property;
  };
  Notes notes;
  const std::string lidar = R"("AVG_HEIGHT":18.5,"MIN_HEIGHT":15,"MAX_HEIGHT":21)";
  CHECK_FALSE(underside(lidar, lidar, notes).has_value());
  CHECK_THAT(listed(notes), Contains("heights from \"AVG_HEIGHT\"") && !Contains("? buildings"));
  notes.clear();
  const std::string roofs = R"("HEIGHT":18.5,"MIN_HEIGHT":15)";
  CHECK_FALSE(underside(roofs, roofs, notes).has_value());
  const std::string gone = R"("height":12,"min_height":13)";  // none would be left
  CHECK_FALSE(underside(gone, gone, notes).has_value());
  CHECK_FALSE(underside(R"("height":12,"min_height":"yes")", R"("height":9)", notes).has_value());
  CHECK_FALSE(underside(R"("measuredHeight":12,"min_height":2)", R"("measuredHeight":9)", notes)
                  .has_value());
  notes.clear();
  CHECK(underside(R"("height":12,"min_height":3)", R"("height":9)", notes) == "min_height");
  CHECK(underside(R"("building:height":12,"building:min_height":3)",
                  R"("building:height":9,"building:min_height":0)",
                  notes) == "building:min_height");
  CHECK_THAT(listed(notes), Contains("? buildings") && Contains("undersides from \"min_height\""));
}

// The reader takes it without being told: its "n/a" refused the file, or it raised all.
TEST_CASE("A render_min_height that is no underside is switched off in a new scene",
          "[new-scene]") {
  Notes notes;
  const auto guess = [&](const std::string& first, const std::string& second) {
    notes.clear();
    return guessed_of(square_with(first, 10.0) + "," + square_with(second, 10.001), notes);
  };
  const auto broken = guess(R"("render_height":10,"render_min_height":"n/a")",
                            R"("render_height":20,"render_min_height":0)");
  CHECK(broken.height_property == "render_height");
  CHECK(broken.min_height_property == "");
  const auto beside = guess(R"("height":10,"RENDER_MIN_HEIGHT":"n/a")", R"("height":20)");
  CHECK(beside.height_property == "height");
  CHECK(beside.min_height_property == "");
  const std::string raised = R"("render_height":20,"render_min_height":4)";
  CHECK(guess(raised, raised).min_height_property == "");
  CHECK_THAT(listed(notes), Contains("? buildings") && Contains("all from the ground up"));
  // One that is an underside counts as before, also beside a height of another name.
  CHECK_FALSE(guess(R"("height":10,"render_min_height":3)", R"("height":20)")
                  .min_height_property.has_value());

  const tests::TemporaryFolder data, folder;
  core::ProblemList problems;
  NewSceneRequest wanted = request(plain(data));
  wanted.buildings = data.write("b.geojson", R"({"type":"FeatureCollection","features":[)" +
                                                 square_with(raised, 10.01) + "]}");
  const auto scene = make_new_scene(wanted, problems);
  INFO(all_of(problems));
  REQUIRE(scene.has_value());
  CHECK_THAT(scene->text, Contains("min_height_property = \"\""));
  CHECK(built(folder, *scene).scene != nullptr);
}

TEST_CASE("Foreign text in a scene file is data, whatever is in it", "[new-scene]") {
  CHECK(toml_text("plain") == "\"plain\"");
  CHECK(toml_text("a\"b\\c\nd") == R"("a\"b\\c\\x0ad")");
  CHECK(toml_text("M\xC3\xBCnchen") == "\"M\xC3\xBCnchen\"");
  CHECK(toml_text("\xFF\x7F") == R"("\\xff\\x7f")");
  core::ProblemList problems;
  for (int first = 0; first < 256; ++first) {
    const std::string text = std::string(1, static_cast<char>(first)) + "x\"]\n[scene]";
    core::ConfigTable table =
        core::ConfigTable::from_text("key = " + toml_text(text) + "\n", "generated", problems);
    INFO("byte " << first);
    REQUIRE_FALSE(problems.has_errors());
    CHECK(table.required_text("key") == core::printable_text(text));
  }
  CHECK(safe_file_name("../../etc/passwd") == "_.._.._etc_passwd");
  CHECK(safe_file_name("N47E009.hgt") == "N47E009.hgt");
  CHECK(safe_words("a\x1B[31mb") == R"(a\x1b[31mb)");
}

TEST_CASE("Numbers of a new scene are TOML floats of the decimals asked for", "[new-scene]") {
  CHECK(rounded(12.5, 2) == "12.5");
  CHECK(rounded(-0.001, 1) == "0.0");
  CHECK(rounded(6000.0, 0) == "6000.0");
  CHECK(rounded(47.66600040, 7) == "47.6660004");
  CHECK(box_text(core::radians(-1.0), core::radians(-0.5), core::radians(-0.5),
                 core::radians(1.0)) == "0.5 to 1.0 S, 0.5 W to 1.0 E");
}

TEST_CASE("Friedrichshafen from a runway table and an SRTM tile: datum, heights, a scene",
          "[new-scene]") {
  const auto srtm = tests::shared_data("srtm-n47e009/N47E009.hgt");
  const auto dted = tests::shared_data("srtm-n47e009/n47_e009.dt1");
  if (!srtm || !dted) return;
  for (const auto& elevation : {*srtm, *dted}) {
    NewSceneRequest wanted;
    wanted.name = "edny-24";
    wanted.runway = "24";
    wanted.elevation = elevation;
    // Of runway_ends_derived.csv.
    Airport edny = airport();
    AirportRunway& runway = edny.runways[0];
    runway.ends[0] = {"06",
                      {core::radians(47.6660004), core::radians(9.4978905), 0.0},
                      406.6,
                      269.7,
                      std::nullopt};
    runway.ends[1] = {"24",
                      {core::radians(47.6766014), core::radians(9.5250902), 0.0},
                      416.7,
                      205.7,
                      std::nullopt};
    runway.width_m = 45.1;
    wanted.airport = edny;
    core::ProblemList problems;
    const auto scene = make_new_scene(wanted, problems);
    INFO(all_of(problems));
    REQUIRE(scene.has_value());
    INFO(listed(scene->notes) << scene->text);
    CHECK_THAT(listed(scene->notes),
               Contains("  vertical datum: egm96: as ") && Contains("15299 without a height"));
    const tests::TemporaryFolder folder;
    const tests::Outcome outcome = built(folder, *scene);
    for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
    REQUIRE(outcome.scene != nullptr);
    // The displaced threshold of the table.
    CHECK(core::degrees(outcome.scene->description.origin.latitude_rad) ==
          Approx(47.6756766).epsilon(0.0).margin(2e-6));
    CHECK(core::degrees(outcome.scene->description.origin.longitude_rad) ==
          Approx(9.5227171).epsilon(0.0).margin(2e-6));
  }
}
