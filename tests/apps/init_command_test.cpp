// fanbeam init, run as a user would: what it writes renders anywhere, and an error writes nothing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "tests/apps/program.h"
#include "tests/shared_data.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam::tests;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

// 2 km due north at 52 N 10 E.
const std::string kRunway =
    "--airport ZZZZ --runway 36 --threshold 52.0,10.0,80 --far-end 52.018,10.0,82 ";

std::string dem(const TemporaryFolder& folder) {
  AsciiGrid grid;
  grid.cell = 0.001;
  grid.columns = grid.rows = 200;
  grid.west = 9.9;
  grid.south = 51.9;
  return quoted(grid.write(folder, "my dem", [](int column, int row) {
    return std::to_string(80.0 + 0.01 * column - 0.02 * row);
  }));
}

}  // namespace

TEST_CASE("init writes a scene that validates and renders from any folder without its data",
          "[init]") {
  const TemporaryFolder data, folder;
  const Result made =
      run_fanbeam("init " + quoted(folder.path() / "field") + " " + kRunway + "--dem " + dem(data));
  INFO(made.output);
  REQUIRE(made.exit_code == 0);
  CHECK_THAT(made.output, Contains("vertical datum") && Contains("ZZZZ 36/18") &&
                              Contains("wrote") && Contains("fanbeam render"));
  CHECK(fs::exists(folder.path() / "field" / "terrain" / "my_dem.asc"));
  CHECK(fs::exists(folder.path() / "field" / "terrain" / "my_dem.prj"));
  fs::remove_all(data.path());  // the scene has its own copies
  fs::rename(folder.path() / "field", folder.path() / "moved");
  const Result valid = run_fanbeam("validate moved", "cd " + quoted(folder.path()) + " &&");
  INFO(valid.output);
  CHECK(valid.exit_code == 0);
  CHECK_THAT(valid.output, Contains("zzzz-36: valid") && !Contains("W-") && !Contains("E-"));
  const Result rendered =
      run_fanbeam("render moved --frames 0 -o pictures", "cd " + quoted(folder.path()) + " &&");
  INFO(rendered.output);
  CHECK(rendered.exit_code == 0);
}

TEST_CASE("init keeps a scene that is there, and --overwrite replaces it", "[init]") {
  const TemporaryFolder data, folder;
  const std::string words = "init " + quoted(folder.path()) + " " + kRunway + "--dem " + dem(data);
  folder.write("notes.txt", "mine");
  REQUIRE(run_fanbeam(words).exit_code == 0);
  folder.write("scene.toml", "by hand");
  const auto before = contents(folder.path());
  const Result refused = run_fanbeam(words);
  INFO(refused.output);
  CHECK(refused.exit_code == 4);
  CHECK_THAT(refused.output, Contains("is there already") && Contains("scene.toml") &&
                                 Contains("my_dem.asc") && Contains("--overwrite") &&
                                 Contains("nothing was written"));
  CHECK(contents(folder.path()) == before);
  const Result replaced = run_fanbeam(words + " --overwrite");
  INFO(replaced.output);
  CHECK(replaced.exit_code == 0);
  CHECK(bytes_of(folder.path() / "notes.txt") == "mine");
  CHECK_THAT(bytes_of(folder.path() / "scene.toml"), Contains("[scene]"));
}

TEST_CASE("init tells everything that is wrong at once and leaves nothing behind", "[init]") {
  const TemporaryFolder data, folder;
  const auto refused = [&](const std::string& words) {
    const Result result =
        run_fanbeam("init " + quoted(folder.path() / "new" / "scene") + " " + words);
    INFO(words << "\n" << result.output);
    CHECK(result.exit_code != 0);
    CHECK(contents(folder.path()).empty());
    return result;
  };
  const Result both = refused("--airport ZZZZ --runway 36 --runways " +
                              quoted(data.write("r.csv", "a,b\n")) + " --dem /nowhere.tif");
  CHECK_THAT(both.output, Contains("neither runway_end nor le_ident") && Contains("E-IO raster"));
  CHECK(both.exit_code == 3);
  // What only building the scene can tell: a flight whose rows are no times of a clock.
  const std::string backwards =
      quoted(data.write("back.csv",
                        "t,lat,lon,alt_msl_m\n0,51.98,10,500\n1,51.981,10,495\n2,51.982,10,490\n"
                        "1.5,51.983,10,485\n3,51.99,10,300\n4,52.0005,10,100\n"));
  const Result late = refused(kRunway + "--dem " + dem(data) + " --track " + backwards);
  CHECK_THAT(late.output, Contains("E-TIME") && Contains("nothing was written"));
  CHECK_THAT(late.output, !Contains(".tmp"));
  const Result far_away = refused(
      "--airport ZZZZ --runway 36 --threshold 10.0,152.0 --far-end 10,53 --dem " + dem(data));
  CHECK(far_away.exit_code == 3);
  CHECK_THAT(far_away.output, Contains("latitude before longitude"));
  CHECK(refused("--airport ZZZZ --runway 36 --threshold 152.0,10.0 --far-end 53,10 --dem " +
                dem(data))
            .exit_code == 2);
  CHECK_THAT(refused("--airport ZZZZ --runway 36 --dem x").output, Contains("--threshold"));
  CHECK(refused(kRunway + "--runways r.csv --dem x").exit_code == 2);
}

TEST_CASE("init takes a recorded flight in feet and dates, and lands it", "[init]") {
  const TemporaryFolder data, folder;
  std::string flight = "UTC,Latitude (deg),Longitude (deg),GPS Altitude\n";
  for (int second = 0; second < 90; ++second) {
    const double before_m = 6000.0 - 70.0 * second;
    // The ellipsoid is 45 m below mean sea level here; 3 deg is 0.0524.
    const double height_m = 80.0 + 45.0 + 15.0 + 0.0524 * std::max(before_m, -200.0);
    char row[120];
    std::snprintf(row, sizeof row, "2009-02-13T23:%02d:%02d.5Z,%.7f,10.0,%.1f\n", 30 + second / 60,
                  second % 60, 52.0 - before_m / 111260.0, height_m / 0.3048);
    flight += row;
  }
  const Result made =
      run_fanbeam("init " + quoted(folder.path() / "field") + " " + kRunway + "--dem " + dem(data) +
                  " --track " + quoted(data.write("log.csv", flight)));
  INFO(made.output);
  REQUIRE(made.exit_code == 0);
  CHECK_THAT(made.output, Contains("feet above the ellipsoid") && Contains("ISO 8601"));
  const std::string scene = bytes_of(folder.path() / "field" / "scene.toml");
  INFO(scene);
  CHECK_THAT(scene, Contains("height_unit = \"ft\"") && Contains("time_unit = \"iso8601\"") &&
                        Contains("file = \"flight/log.csv\""));
}

TEST_CASE("init names files of a data folder instead of copying them", "[init]") {
  const TemporaryFolder data, folder;
  const std::string words = "init " + quoted(folder.path() / "field") + " " + kRunway + "--dem " +
                            dem(data) + " --data " + quoted(data.path());
  const Result made = run_fanbeam(words);
  INFO(made.output);
  REQUIRE(made.exit_code == 0);
  CHECK_THAT(bytes_of(folder.path() / "field" / "scene.toml"),
             Contains("elevation = \"my dem.asc\""));
  CHECK(contents(folder.path() / "field").size() == 1);
  CHECK(
      run_fanbeam("validate " + quoted(folder.path() / "field") + " --data " + quoted(data.path()))
          .exit_code == 0);
}

TEST_CASE("What init says comes next is what a shell takes back", "[init]") {
  const TemporaryFolder data, folder;
  dem(data);
  fs::copy(data.path(), folder.path() / "da ta");
  const Result made =
      run_fanbeam("init \"it's\" " + kRunway + "--dem 'da ta/my dem.asc' --data 'da ta'",
                  "cd " + quoted(folder.path()) + " &&");
  INFO(made.output);
  REQUIRE(made.exit_code == 0);
  CHECK_THAT(made.output, Contains("next:  fanbeam render 'it'\\''s' --data 'da ta' --frames 0\n"
                                   "       fanbeam doctor 'it'\\''s' --data 'da ta'\n"));
}

TEST_CASE("init makes Friedrichshafen 24 and 06 of a runway table and an SRTM tile", "[init]") {
  const auto runways = shared_data("airports/runway_ends_derived.csv");
  const auto tile = shared_data("srtm-n47e009/N47E009.hgt");
  if (!runways || !tile) return;
  const TemporaryFolder folder;
  for (const std::string end : {"24", "06"}) {
    const fs::path scene = folder.path() / ("edny" + end);
    const Result made = run_fanbeam("init " + quoted(scene) + " --airport EDNY --runway " + end +
                                    " --runways " + quoted(*runways) + " --dem " + quoted(*tile));
    INFO(made.output);
    REQUIRE(made.exit_code == 0);
    CHECK_THAT(made.output, Contains("egm96: as SRTM .hgt files have") &&
                                Contains("EDNY 06/24, 2358 x 45.1 m, landing on " + end) &&
                                Contains("asphalt_worn"));
    CHECK(run_fanbeam("validate " + quoted(scene), "env -u FANBEAM_DATA").exit_code == 0);
  }
  const Result unknown =
      run_fanbeam("init " + quoted(folder.path() / "x") + " --airport EDNZ --runway 24 --runways " +
                  quoted(*runways) + " --dem " + quoted(*tile));
  CHECK(unknown.exit_code == 3);
  CHECK_THAT(unknown.output, Contains("EDNY"));
}
