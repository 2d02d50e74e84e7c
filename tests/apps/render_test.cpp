// What render leaves on disk: documented records, the same bytes however it is run, and frames
// taken up again.
#include <algorithm>
#include <filesystem>

#include "core/image.h"
#include "tests/apps/program.h"
#include "tests/comma_locale.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

// Frames of the obstacle field, cheap but with noise-free texture, walls and targets.
const std::string kCheapFrames = " --frames 100:160:20 --rays-per-cell 1 -q ";

std::vector<std::string> keys_of(const nlohmann::json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

void check_has(const nlohmann::json& json, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    INFO(key);
    CHECK(json.contains(key));
  }
}

}  // namespace

TEST_CASE("The output folder holds the pictures by frame number, run.json and timing.json",
          "[render]") {
  const TemporaryFolder folder;
  render("obstacle-field", folder.path() / "out",
         kCheapFrames + "--products bscope,cscope,power,ppi");
  std::vector<std::string> files;
  for (const auto& [name, bytes] : contents(folder.path() / "out"))
    if (!bytes.empty()) files.push_back(name);
  CHECK(files == std::vector<std::string>{
                     "bscope/00100.png", "bscope/00120.png", "bscope/00140.png", "cscope/00100.png",
                     "cscope/00120.png", "cscope/00140.png", "power/00100.exr", "power/00120.exr",
                     "power/00140.exr", "ppi/00100.png", "ppi/00120.png", "ppi/00140.png",
                     "run.json", "timing.json"});
  for (const char* product : {"bscope", "cscope"}) {
    const core::Image picture = core::read_image(folder.path() / "out" / product / "00120.png");
    CHECK(picture.columns == 164);
    CHECK(picture.rows == 524);
    CHECK(picture.layers.size() == 1);
  }
  const core::Image power = core::read_image(folder.path() / "out/power/00120.exr");
  REQUIRE(power.layers.size() == 1);
  CHECK(power.layers[0].name == "power_W");
  // The farthest range is on top: the bottom rows lie below the beam.
  CHECK(power.layers[0].values[82] > 0.0);
  CHECK(std::all_of(power.layers[0].values.begin(), power.layers[0].values.end(),
                    [](double w) { return w >= 0.0 && w < 1.0; }));
}

TEST_CASE("run.json and timing.json have their documented keys, pictures the essentials",
          "[render]") {
  const TemporaryFolder folder;
  render("obstacle-field", folder.path(), kCheapFrames + "--seed 7 --threads 2");
  const nlohmann::json run = json_of(folder.path() / "run.json");
  check_has(run,
            {"version", "commit", "scene", "sensor", "seed", "caster", "input", "plan", "frames"});
  CHECK(run["scene"] == "obstacle-field");
  CHECK(run["sensor"] == "HiVision");
  CHECK(run["seed"] == 7);
  CHECK(run["caster"]["chosen"] == "profile");
  CHECK(run["input"]["weather.visibility_m"] == 200.0);
  CHECK(run["input"]["terrain.spacing_m"] == 10.0);
  CHECK(run["input"]["trajectory.ils.flare_height_m"] == 12.0);  // a default
  REQUIRE(run["plan"].size() >= 4);
  for (const nlohmann::json& effect : run["plan"]) {
    CHECK(keys_of(effect) == std::vector<std::string>{"bound_grey", "effect", "on", "reason"});
    CHECK_FALSE(effect["reason"].get<std::string>().empty());
  }
  REQUIRE(run["frames"].size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const nlohmann::json& frame = run["frames"][i];
    check_has(frame, {"index", "time_s", "pose", "rays", "slices", "events"});
    CHECK(frame["index"] == 100 + 20 * i);
    CHECK(frame["time_s"].get<double>() ==
          (100.5 + 20.0 * static_cast<double>(i)) / 16.0);  // the middle of the frame
    check_has(frame["pose"], {"latitude_deg", "longitude_deg", "height_m", "roll_deg", "pitch_deg",
                              "heading_deg"});
    CHECK(frame["rays"] > 10000);  // of bounces
    CHECK(frame["slices"] > 164);
  }

  const nlohmann::json timing = json_of(folder.path() / "timing.json");
  check_has(timing, {"threads", "isa", "machine", "frames", "summary"});
  CHECK(timing["threads"] == 2);
  check_has(timing["summary"], {"frame_ms_median", "frames_per_s", "rays_per_s", "scene_build_s",
                                "peak_memory_bytes"});
  CHECK(timing["frames"].size() == 3);
  CHECK(timing["frames"][0]["index"] == 100);
  CHECK(timing["frames"][0]["frame_ms"] > 0.0);

  const core::Metadata notes = core::read_metadata(folder.path() / "cscope/00140.png");
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"fanbeam:scene", "obstacle-field"},
                                                        {"fanbeam:sensor", "HiVision"},
                                                        {"fanbeam:frame", "140"},
                                                        {"fanbeam:time_s", "8.78125"}})
    CHECK(std::count(notes.begin(), notes.end(), std::pair{name, value}) == 1);
}

TEST_CASE("PNG and EXR carry the whole pose, as their own formats write text", "[render]") {
  const TemporaryFolder folder;
  // Turbulence rolls the aircraft.
  render("braunschweig-26", folder.path(),
         "--frames 700 --rays-per-cell 0.3 -q --products bscope,power");
  const nlohmann::json pose = json_of(folder.path() / "run.json")["frames"][0]["pose"];
  const std::string png = bytes_of(folder.path() / "bscope/00700.png");
  const std::string exr = bytes_of(folder.path() / "power/00700.exr");
  CHECK(std::abs(pose["roll_deg"].get<double>()) > 0.01);
  CHECK(std::abs(pose["pitch_deg"].get<double>()) > 0.01);
  for (const char* part :
       {"latitude_deg", "longitude_deg", "height_m", "roll_deg", "pitch_deg", "heading_deg"}) {
    INFO(part);
    const std::string key = std::string("fanbeam:") + part;
    const auto value_at = [](const std::string& file, const std::string& before) {
      const std::size_t at = file.find(before);
      REQUIRE(at != std::string::npos);
      return std::stod(file.substr(at + before.size(), 30));
    };
    // A tEXt chunk: keyword, zero, text. An attribute: name, type, four bytes of size, text.
    CHECK(value_at(png, "tEXt" + key + '\0') == pose[part].get<double>());
    const std::size_t at = exr.find(key + '\0' + "string" + '\0');
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(exr.substr(at + key.size() + 12, 30)) == pose[part].get<double>());
  }
}

TEST_CASE("Rows of a flight that were left out are counted on the terminal and listed in run.json",
          "[render]") {
  const TemporaryFolder folder;
  std::string rows = "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  for (int t = 0; t <= 20; ++t)
    rows += std::to_string(t) + "," + std::to_string(52.0 + 0.0005 * t) + ",10," +
            (t == 7 ? "9000" : "200") + ",0,0,0\n";
  folder.write("flight.csv", rows);
  const auto scene = [&](const std::string& policy) {
    folder.write("scene.toml",
                 "[scene]\nname = \"flown\"\nvertical_datum = \"scene\"\n"
                 "origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }\n"
                 "[terrain]\nhalf_extent_m = 3000.0\nspacing_m = 100.0\n"
                 "[trajectory]\nfile = \"flight.csv\"\nvertical_datum = \"scene\"\n"
                 "outliers = \"" +
                     policy + "\"\n");
  };
  const std::string words = "render " + quoted(folder.path()) + " --frames 0 --rays-per-cell 1 -o ";
  scene("error");
  const Result refused = run_fanbeam(words + quoted(folder.path() / "refused"));
  CHECK(refused.exit_code == 3);
  CHECK(refused.output.find("flight.csv:9: E-RANGE row 8, height = 9000 m") != std::string::npos);

  scene("reject");
  const Result rejected = run_fanbeam(words + quoted(folder.path() / "rejected"));
  INFO(rejected.output);
  REQUIRE(rejected.exit_code == 0);
  CHECK(rejected.output.find("W-OUTLIER") != std::string::npos);
  const nlohmann::json listed =
      json_of(folder.path() / "rejected/run.json")["trajectory_rows_rejected"];
  REQUIRE(listed.size() == 1);
  CHECK(listed[0]["first_row"] == 8);
  CHECK(listed[0]["last_row"] == 8);
  CHECK(listed[0]["rows"] == 1);
  CHECK(listed[0]["first_line"] == 9);
  CHECK(listed[0]["why"] == "height");

  scene("keep");
  const Result kept = run_fanbeam(words + quoted(folder.path() / "kept"));
  CHECK(kept.exit_code == 0);
  CHECK_FALSE(json_of(folder.path() / "kept/run.json").contains("trajectory_rows_rejected"));
}

TEST_CASE("Two runs and any number of threads give the same bytes in everything but timing.json",
          "[render]") {
  const TemporaryFolder folder;
  for (const auto& [scene, words] : std::vector<std::pair<std::string, std::string>>{
           {"flat-grass", " -q --products bscope,cscope,power "},
           {"obstacle-field", kCheapFrames + "--products bscope,cscope,power,ppi "}}) {
    render(scene, folder.path() / (scene + "-1"), words + "--threads 1");
    const auto first = results(folder.path() / (scene + "-1"));
    CHECK(first.size() >= 4);
    for (const char* threads : {"1", "2", "3", "8"}) {
      INFO(scene << " with " << threads << " threads");
      const fs::path again = folder.path() / (scene + "-again");
      fs::remove_all(again);
      render(scene, again, words + "--threads " + threads);
      CHECK((results(again) == first));
    }
  }
}

TEST_CASE("A frame does not depend on which frames were rendered before it", "[render]") {
  const TemporaryFolder folder;
  render("obstacle-field", folder.path() / "together", kCheapFrames);
  for (const char* frame : {"140", "100", "120"}) {
    render("obstacle-field", folder.path() / frame,
           std::string("--rays-per-cell 1 -q --frames ") + frame);
    for (const std::string product : {"bscope", "cscope"}) {
      const std::string name = product + "/00" + frame + ".png";
      INFO(name);
      CHECK(
          (bytes_of(folder.path() / frame / name) == bytes_of(folder.path() / "together" / name)));
    }
  }
}

TEST_CASE("F18 the same bytes from another working directory, time zone, locale and folder name",
          "[render]") {
  const TemporaryFolder folder;
  render("flat-grass", folder.path() / "plain", "-q");
  const fs::path odd = folder.path() / "Bilder für Zoë – 東";
  const Result result = run_fanbeam("render flat-grass -q -o " + quoted(odd),
                                    "cd / && TZ=Asia/Tokyo LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8");
  CHECK(result.exit_code == 0);
  CHECK((results(odd) == results(folder.path() / "plain")));
}

TEST_CASE(
    "F18 the same bytes of a scene in a folder with blanks and umlauts, under a decimal comma",
    "[render]") {
  const CommaLocale comma;
  if (!comma.made()) return;
  const TemporaryFolder folder;
  const auto write_scene = [&](const std::string& name) {
    fs::create_directories(folder.path() / name);
    folder.write(name + "/scene.toml",
                 "[scene]\nname = \"approach\"\n"
                 "origin = { latitude_deg = 52.0, longitude_deg = 10.0 }\n"
                 "vertical_datum = \"scene\"\n"
                 "[terrain]\nhalf_extent_m = 1500.0\nspacing_m = 50.0\n"
                 "[weather]\nvisibility_m = 350.5\nrain_rate_mm_per_h = 2.5\n"
                 "[trajectory]\nfile = \"Flug Nº 1.csv\"\nvertical_datum = \"scene\"\n");
    folder.write(name + "/Flug Nº 1.csv",
                 "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n"
                 "0,52.001,10.0005,60.25,0.5,-1.5,1.5\n");
  };
  write_scene("plain");
  write_scene("Anflug Zürich 14 – 東");
  const std::string words = " -q --rays-per-cell 1.5 --products bscope,cscope,power,ppi -o ../";
  const auto render_in = [&](const std::string& scene, const std::string& out,
                             const std::string& environment) {
    const Result result =
        run_shell("cd " + quoted(folder.path() / scene) + " && " + environment +
                  " '" FANBEAM_BINARY_DIR "/bin/fanbeam' render ." + words + out + " 2>&1");
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    return results(folder.path() / out);
  };
  const auto plain = render_in("plain", "a", "TZ=UTC LC_ALL=C");
  CHECK(plain.size() >= 5);
  CHECK((render_in("Anflug Zürich 14 – 東", "b", "TZ=Asia/Kathmandu " + comma.environment()) ==
         plain));
}

TEST_CASE(
    "--resume keeps finished frames and renders those that are missing, damaged or of another "
    "input",
    "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  render("obstacle-field", out, kCheapFrames);
  const auto whole = results(out);
  const auto kept_time = fs::last_write_time(out / "bscope/00100.png");

  // One frame is gone, one cut short: its head with all notes is still there.
  fs::remove(out / "cscope/00120.png");
  fs::resize_file(out / "bscope/00140.png", fs::file_size(out / "bscope/00140.png") - 100);
  const Result resumed = run_fanbeam("render obstacle-field -o " + quoted(out) +
                                     " --frames 100:160:20 --rays-per-cell 1 --resume");
  CHECK(resumed.exit_code == 0);
  CHECK(resumed.output.find("(1 already there)") != std::string::npos);
  CHECK((results(out) == whole));
  CHECK(fs::last_write_time(out / "bscope/00100.png") == kept_time);
  CHECK(json_of(out / "timing.json")["frames"].size() == 2);

  // Another input makes every frame anew; without --resume too.
  const Result other = run_fanbeam("render obstacle-field -o " + quoted(out) +
                                   " --frames 100:160:20 --rays-per-cell 2 --resume");
  CHECK(other.output.find("already there") == std::string::npos);
  CHECK_FALSE((results(out) == whole));
  render("obstacle-field", out, kCheapFrames);
  CHECK((results(out) == whole));
  CHECK(fs::last_write_time(out / "bscope/00100.png") != kept_time);
}

TEST_CASE("--resume notices that a file which the scene names has changed", "[render]") {
  const TemporaryFolder folder;
  const std::string head =
      "[scene]\nname = \"t\"\norigin = { latitude_deg = 52.0, longitude_deg = 10.0 "
      "}\nvertical_datum = \"scene\"\n"
      "[terrain]\nhalf_extent_m = 1000.0\nspacing_m = 100.0\n";
  folder.write("scene.toml",
               head + "[trajectory]\nfile = \"flight.csv\"\nvertical_datum = \"scene\"\n");
  const std::string rows =
      "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n0,52,10,60,0,0,"
      "0\n";
  folder.write("flight.csv", rows);
  const std::string words = "render " + quoted(folder.path()) + " --rays-per-cell 1 --resume -o " +
                            quoted(folder.path() / "out");
  REQUIRE(run_fanbeam(words).exit_code == 0);
  CHECK(run_fanbeam(words).output.find("(1 already there)") != std::string::npos);
  folder.write("flight.csv", rows + "# checked\n");
  CHECK(run_fanbeam(words).output.find("already there") == std::string::npos);
}

TEST_CASE("Without ffmpeg a preview is refused with exit code 4 and the package's name",
          "[render]") {
  const TemporaryFolder folder;
  const Result result =
      run_fanbeam("render flat-grass -q --products preview -o " + quoted(folder.path() / "out"),
                  "PATH=/nowhere");
  CHECK(result.exit_code == 4);
  CHECK(result.output.find("Debian package ffmpeg") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out/run.json"));
}
