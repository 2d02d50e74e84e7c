// No command writes its output over a file that it reads, whatever name that file goes by.
#include <sys/stat.h>

#include "tests/apps/plain_scene.h"
#include "tests/apps/program.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

constexpr const char* kDetections =
    "time_s,range_m,radial_speed_mps,azimuth_deg\n0,60,-8,5\n0.1,59.2,-8,5\n0.2,58.4,-8,5\n";

// That it is refused as a fault of that option, and that nothing in the folder is other afterwards.
void check_refused(const fs::path& folder, const std::string& words, const std::string& option) {
  const auto before = contents(folder);
  const Result result = run_fanbeam(words, "cd " + quoted(folder) + " && ");
  INFO(words << "\n" << result.output);
  CHECK(result.exit_code == 2);
  CHECK(result.output.find(option + " = \"") != std::string::npos);
  CHECK((contents(folder) == before));
}

}  // namespace

TEST_CASE("track writes over no table but its own, and puts none among those that it reads",
          "[track][inputs]") {
  const TemporaryFolder folder;
  for (const char* name : {"mine", "tables", "other", "clock", "pipe"})
    fs::create_directory(folder.path() / name);
  for (const char* name : {"m.csv", "mine/measurements.csv", "tables/1.csv"})
    folder.write(name, kDetections);
  folder.write("other/tracks.csv", "somebody's\n");
  folder.write("clock/timing.json", "{}");
  fs::create_symlink("tables", folder.path() / "link");
  check_refused(folder.path(), "track mine/measurements.csv -o mine", "--output");
  for (const char* out : {"mine", "other", "clock"})
    check_refused(folder.path(), std::string("track m.csv -o ") + out, "--output");
  for (const char* out : {"tables", "link", "tables/../tables", "tables/detections"})
    check_refused(folder.path(), std::string("track tables -o ") + out, "--output");
  check_refused(folder.path() / "tables", "track . -o .", "--output");
  REQUIRE(::mkfifo((folder.path() / "pipe/tracks.csv").c_str(), 0600) == 0);  // nobody writes to it
  CHECK(track(folder.path() / "m.csv", folder.path() / "pipe").exit_code == 2);

  // Below its own folder, beside the input, and once more where it wrote before.
  for (const char* out : {"tables/tracks", "tables/tracks"})
    CHECK(track(folder.path() / "tables", folder.path() / out).exit_code == 0);
  CHECK(track(folder.path() / "m.csv", folder.path()).exit_code == 0);
  // Of a run that was stopped there are tables without a record.
  fs::remove(folder.path() / "tables/tracks/run.json");
  fs::remove(folder.path() / "tables/tracks/timing.json");
  CHECK(track(folder.path() / "m.csv", folder.path() / "tables/tracks").exit_code == 0);
}

TEST_CASE("What was measured is not replaced by what is measured of it", "[track][inputs]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "hw");
  const std::string scenario = bytes_of(FANBEAM_SOURCE_DIR "/scenes/highway-76ghz/traffic.json");
  REQUIRE_FALSE(scenario.empty());
  folder.write("hw/run.json", scenario);
  check_refused(folder.path(), "track hw/run.json -o hw", "--output");
}

TEST_CASE("A scene's files are no place for what is told of it", "[doctor][live][inputs]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", kPlainOverGrass + "[sensor]\nfile = \"radar.toml\"\n");
  folder.write("radar.toml", narrow_sensor(4));
  folder.write("f.csv",
               "time_s,latitude_deg,longitude_deg,height_m\n0,52.0,10.0,100\n10,52.0,10.01,90\n");
  folder.write("token", "0123456789abcdef\n");
  fs::create_symlink("scene.toml", folder.path() / "link.json");
  fs::create_hard_link(folder.path() / "radar.toml", folder.path() / "hard.json");
  for (const char* file : {"scene.toml", "radar.toml", "link.json", "hard.json"})
    check_refused(folder.path(), std::string("doctor . --json ") + file, "--json");
  const std::string live = "live . --http 0 --lockstep --frames 1 --from csv:f.csv ";
  check_refused(folder.path(), live + "--record f.csv", "--record");
  check_refused(folder.path(), live + "--token-file token --record token", "--record");
  for (const char* file : {"scene.toml", "f.csv", "hard.json"})
    check_refused(folder.path(), live + "--to raw-bscope:" + file, "--to");
  const std::string in = "cd " + quoted(folder.path()) + " && ";
  const Result flown = run_fanbeam(live + "--record recording --to raw-bscope:film", in);
  INFO(flown.output);
  REQUIRE(flown.exit_code == 0);
  check_refused(folder.path(),
                "live . --http 0 --lockstep --replay recording --to raw-bscope:recording", "--to");
}

TEST_CASE("The suite, its pictures and its scenes are no place for its report",
          "[regress][inputs]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "approved");
  folder.write("scene.toml", kPlainOverGrass);
  folder.write("suite.toml",
               "name = \"test\"\n\n[[case]]\nname = \"grass\"\nscene = \".\"\nframes = \"0\"\n");
  for (const char* file : {"suite.toml", "scene.toml", "approved/junit.xml"})
    check_refused(folder.path(), std::string("regress run suite.toml -o out --junit ") + file,
                  "--junit");
}
