// A folder of pictures holds one input: what render and fmcw replace there, keep, and refuse to mix
// with.
#include "session/records/output_folder.h"

#include <algorithm>

#include "core/errors.h"
#include "core/image.h"
#include "tests/apps/child.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

const std::string kFewRays = " --rays-per-cell 1 -q ";

Result render_quickly(const fs::path& folder, const std::string& words) {
  return run_fanbeam("render " + words + kFewRays + "-o " + quoted(folder));
}

void must_render(const fs::path& folder, const std::string& words) {
  const Result result = render_quickly(folder, words);
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& [name, bytes] : contents(folder))
    if (fs::is_regular_file(folder / name)) files.push_back(name);
  return files;
}

// What run.json lists, with itself and the times.
std::vector<std::string> files_told(const fs::path& folder) {
  const nlohmann::json run = json_of(folder / "run.json");
  std::vector<std::string> files = {"run.json", "timing.json"};
  for (const nlohmann::json& frame : run["frames"])
    for (const nlohmann::json& file : frame["files"]) files.push_back(file);
  if (run.contains("files"))
    for (const nlohmann::json& file : run["files"]) files.push_back(file);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

TEST_CASE("Another input replaces exactly the pictures that run.json lists", "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "obstacle-field --frames 100:160:20 --products bscope,power");
  must_render(out, "flat-grass --frames 0");
  CHECK(files_in(out) == std::vector<std::string>{"bscope/00000.png", "cscope/00000.png",
                                                  "run.json", "timing.json"});
  CHECK(files_told(out) == files_in(out));
  CHECK(json_of(out / "run.json")["scene"] == "flat-grass");
  CHECK_FALSE(fs::exists(out / "power"));
}

// It was gone with the first frame that was made, whatever became of that.
TEST_CASE("A run that could write no picture leaves the one before it whole, its record too",
          "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "obstacle-field --frames 100 --products power,layers");
  const auto before = contents(out);
  // No file can take its place, whoever asks.
  fs::create_directories(out / "bscope/00100.png");
  folder.write("out/bscope/00100.png/.kept", "");
  const Result failed =
      render_quickly(out, "obstacle-field --frames 100 --products bscope --seed 5");
  INFO(failed.output);
  CHECK(failed.exit_code == 4);
  for (const auto& [name, bytes] : before) {
    INFO(name);
    CHECK(contents(out)[name] == bytes);
  }
  CHECK_FALSE(fs::exists(out / ".unfinished.json"));
}

TEST_CASE("Frames of the same input stay, and run.json is that of all frames rendered at once",
          "[render]") {
  const TemporaryFolder folder;
  const std::string scene = "obstacle-field --products bscope,obstacles,detections ";
  must_render(folder.path() / "whole", scene + "--frames 100:180:20");
  const fs::path out = folder.path() / "parts";
  must_render(out, scene + "--frames 160");
  must_render(out, scene + "--frames 100:140:20");
  must_render(out, scene + "--frames 140");
  CHECK((results(out) == results(folder.path() / "whole")));
  CHECK(files_told(out) == files_in(out));
  // A product more of one frame is listed with what is there of it.
  must_render(out, "obstacle-field --frames 120 --products obstacles,detections,power");
  CHECK(files_told(out) == files_in(out));
  CHECK(json_of(out / "run.json")["frames"][1]["files"].size() == 5);
}

// The next run of other products removed it without a word.
TEST_CASE("A film of the same input stays and is listed, and goes with its input", "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "obstacle-field --frames 100:140:20 --products bscope");
  // As a run with the product preview leaves it, which takes ffmpeg.
  nlohmann::json record = json_of(out / "run.json");
  record["files"] = nlohmann::json::array({"preview.gif"});
  folder.write("out/run.json", record.dump());
  folder.write("out/preview.gif", "a film");
  for (const char* words :
       {"--frames 100 --products power,labels", "--frames 100:180:20 --products bscope --resume",
        "--frames 100 --products bscope --overwrite"}) {
    INFO(words);
    must_render(out, std::string("obstacle-field ") + words);
    CHECK(bytes_of(out / "preview.gif") == "a film");
    CHECK(files_told(out) == files_in(out));
  }
  must_render(out, "obstacle-field --frames 100 --products bscope --seed 5");
  CHECK_FALSE(fs::exists(out / "preview.gif"));
}

TEST_CASE("Pictures that a stopped run of the same input left are taken over without its record",
          "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const std::string scene = "obstacle-field --products bscope,obstacles ";
  must_render(out, scene + "--frames 100:160:20");
  for (const char* record : {"run.json", "timing.json"}) fs::remove(out / record);
  must_render(out, scene + "--frames 200");
  CHECK(json_of(out / "run.json")["frames"].size() == 4);
  CHECK(files_told(out) == files_in(out));
}

TEST_CASE("The summary counts the frames asked for, and tells those that are kept and removed",
          "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto told = [&](const std::string& words) {
    return run_fanbeam("render obstacle-field --products bscope --rays-per-cell 1 --resume " +
                       words + " -o " + quoted(out))
        .output;
  };
  told("--frames 100:160:20");
  const std::string one = told("--frames 200");
  INFO(one);
  CHECK(one.find("1 frame in ") != std::string::npos);
  CHECK(one.find("already there") == std::string::npos);
  CHECK(one.find("3 frames of the same input there before and kept\n") != std::string::npos);
  CHECK(one.find("removed") == std::string::npos);
  const std::string other = told("--frames 100 --effects none");
  INFO(other);
  CHECK(other.find("3 frames of another input removed\n") != std::string::npos);
  CHECK(files_in(out) == std::vector<std::string>{"bscope/00100.png", "run.json", "timing.json"});
}

TEST_CASE("A folder with other files is refused by their names, and --overwrite leaves them",
          "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "obstacle-field --frames 100:140:20 --products bscope");
  fs::remove(out / "run.json");  // nobody says whose the pictures are
  std::ofstream(out / "notes.txt") << "mine";
  std::ofstream(out / "bscope/mine.png") << "mine";
  std::ofstream(out / ".hidden") << "mine";
  const auto before = contents(out);
  for (const char* more : {"", " --resume"}) {
    const Result refused = render_quickly(out, std::string("flat-grass --frames 0") + more);
    INFO(refused.output);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.find("bscope/00100.png, bscope/00120.png, bscope/mine.png, notes.txt") !=
          std::string::npos);
    CHECK(refused.output.find("--overwrite") != std::string::npos);
    CHECK(refused.output.find(".hidden") == std::string::npos);
    CHECK((contents(out) == before));
  }
  must_render(out, "flat-grass --frames 0 --products bscope --overwrite");
  CHECK(files_in(out) == std::vector<std::string>{".hidden", "bscope/00000.png", "bscope/mine.png",
                                                  "notes.txt", "run.json", "timing.json"});
  CHECK(bytes_of(out / "notes.txt") == "mine");
  // Refused again: what is not ours does not become so.
  CHECK(render_quickly(out, "flat-grass --frames 0").exit_code == 2);
}

// Masks and labels that a person made went by their names alone.
TEST_CASE("--overwrite leaves files with the names of frames that no render wrote",
          "[render][fmcw]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "flat-grass --frames 0 --products labels,masks");
  for (const char* record : {"run.json", "timing.json"}) fs::remove(out / record);
  const std::map<std::string, std::string> mine = {{"masks/00012.png", "mine"},
                                                   {"labels/00012.json", "{}"},
                                                   {"labels/00013.json", R"({"metadata": {}})"},
                                                   {"detections/00012.csv", "range_m\n100\n"}};
  fs::create_directories(out / "detections");
  for (const auto& [name, bytes] : mine) folder.write("out/" + name, bytes);
  for (const std::string command : {"fmcw street-76ghz --frames 0 --products beat",
                                    "render flat-grass --frames 0 --products bscope"}) {
    const Result result = run_fanbeam(command + " --overwrite -q -o " + quoted(out));
    INFO(command << ": " << result.output);
    CHECK(result.exit_code == 0);
    for (const auto& [name, bytes] : mine) CHECK(bytes_of(out / name) == bytes);
    CHECK_FALSE(fs::exists(out / "masks/00000.png"));
    CHECK_FALSE(fs::exists(out / "labels/00000.json"));
  }
}

TEST_CASE("A hostile run.json cannot have files removed outside the folder, nor others in it",
          "[render]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  fs::create_directories(out / "bscope");
  fs::create_directories(folder.path() / "else/bscope");
  const fs::path outside = folder.write("else/bscope/00007.png", "kept");
  fs::create_directory_symlink(folder.path() / "else/bscope", out / "cscope");
  std::ofstream(out / "bscope/00009.png") << "listed";
  std::ofstream(out / "run.json") << R"({"files": ["../else/bscope/00007.png", ")"
                                  << outside.string()
                                  << R"(", "cscope/00007.png", 7, "bscope/00009.png"],)"
                                  << R"("frames": [{"files": ["../../etc/passwd"]}, 3]})";
  must_render(out, "flat-grass --frames 0 --products bscope");
  CHECK(bytes_of(outside) == "kept");
  CHECK_FALSE(fs::exists(out / "bscope/00009.png"));
  for (const std::string record : {"{", "[]", "{\"files\": \"bscope\"}", "{\"frames\": {}}"}) {
    std::ofstream(out / "run.json") << record;
    INFO(record);
    CHECK(render_quickly(out, "obstacle-field --frames 100").exit_code == 2);
    CHECK(bytes_of(out / "run.json") == record);
  }
}

TEST_CASE("fmcw replaces what its record lists and refuses other files", "[fmcw]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto fmcw = [&](const std::string& words) {
    return run_fanbeam("fmcw street-76ghz -q -o " + quoted(out) + " " + words);
  };
  REQUIRE(fmcw("--frames 0 --products detections,beat").exit_code == 0);
  CHECK(files_told(out) == files_in(out));
  REQUIRE(fmcw("--frames 1 --products detections").exit_code == 0);
  CHECK(files_in(out) == std::vector<std::string>{"detections/00001.csv", "detections/00001.json",
                                                  "radar.toml", "run.json", "timing.json"});
  std::ofstream(out / "notes.txt") << "mine";
  CHECK(fmcw("--frames 1 --products detections").exit_code == 2);
  CHECK(fmcw("--frames 1 --products detections --overwrite").exit_code == 0);
  CHECK(bytes_of(out / "notes.txt") == "mine");
}

// Their files were listed nowhere: the same command was refused the second time, as if they were somebody's.
TEST_CASE("fmcw lists and replaces a lone B-scope and a spectrogram", "[fmcw][scan]") {
  const TemporaryFolder folder;
  folder.write("few.toml", narrow_sensor(1));
  const fs::path out = folder.path() / "out";
  const auto fmcw = [&](const std::string& words) {
    const Result result = run_fanbeam("fmcw " + words + " -q -o " + quoted(out));
    INFO(result.output);
    REQUIRE(result.exit_code == 0);
    CHECK(files_told(out) == files_in(out));
  };
  const std::string bscope = "braunschweig-26 --products bscope --looks 1 --sensor " +
                             quoted(folder.path() / "few.toml") + " --frames ";
  for (int time = 0; time < 2; ++time) {
    INFO("time " << time);
    fmcw(bscope + "400:402");
    CHECK(files_in(out) == std::vector<std::string>{"bscope/00400.exr", "bscope/00400.png",
                                                    "bscope/00401.exr", "bscope/00401.png",
                                                    "run.json", "timing.json"});
  }
  fmcw(bscope + "400");
  CHECK_FALSE(fs::exists(out / "bscope/00401.png"));
  for (int time = 0; time < 2; ++time) {
    INFO("time " << time);
    fmcw("street-76ghz --frames 16:18 --products spectrogram");
    CHECK(files_in(out) == std::vector<std::string>{"radar.toml", "run.json", "spectrogram/all.exr",
                                                    "spectrogram/all.png", "timing.json"});
  }
  fmcw("street-76ghz --frames 16 --products detections");
  CHECK_FALSE(fs::exists(out / "spectrogram"));
}

TEST_CASE("What a killed fmcw leaves is replaced by the next run, and nothing else is",
          "[fmcw][stop]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto fmcw = [&](const std::string& words) {
    return run_fanbeam("fmcw street-76ghz -q -o " + quoted(out) + " " + words);
  };
  REQUIRE(fmcw("--frames 0 --products detections").exit_code == 0);
  const std::string record = bytes_of(out / "run.json");
  Child child({"fmcw", "street-76ghz", "-q", "-o", out.string(), "--frames", "1:40", "--products",
               "detections,beat"});
  while (child.running() && !fs::exists(out / "detections/00002.json")) wait_ms(5.0);
  REQUIRE(child.running());
  child.send(SIGKILL);
  child.wait();
  // The files are other frames' and another radar's than these said.
  CHECK_FALSE(fs::exists(out / "run.json"));
  CHECK_FALSE(fs::exists(out / "radar.toml"));
  const Result tracked =
      run_fanbeam("track " + quoted(out) + " -o " + quoted(folder.path() / "tracks"));
  INFO(tracked.output);
  CHECK(tracked.output.find("W-UNFINISHED") != std::string::npos);
  std::ofstream(out / "notes.txt") << "mine";
  CHECK(fmcw("--frames 3 --products detections").exit_code == 2);
  fs::remove(out / "notes.txt");
  // Nor is a record that lists nothing one of ours because a run was killed beside it.
  std::ofstream(out / "run.json") << "{}";
  CHECK(fmcw("--frames 3 --products detections").exit_code == 2);
  CHECK(bytes_of(out / "run.json") == "{}");
  std::ofstream(out / "run.json") << record;
  REQUIRE(fmcw("--frames 3 --products detections").exit_code == 0);
  CHECK(files_in(out) == std::vector<std::string>{"detections/00003.csv", "detections/00003.json",
                                                  "radar.toml", "run.json", "timing.json"});
}

TEST_CASE("A killed run of another input leaves no record of files that it has replaced",
          "[render][stop]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  must_render(out, "flat-grass --frames 0 --products bscope,labels,layers");
  const auto before = contents(out);
  CHECK(render_quickly(out, "obstacle-field --frames 0 --products bscope,nonsense").exit_code == 2);
  CHECK((contents(out) == before));
  Child child({"render", "obstacle-field", "--rays-per-cell", "1", "-q", "-o", out.string(),
               "--frames", "0:400", "--products", "bscope"});
  while (child.running() && bytes_of(out / "bscope/00000.png") == before.at("bscope/00000.png"))
    wait_ms(5.0);
  REQUIRE(child.running());
  child.send(SIGKILL);
  child.wait();
  for (const char* gone : {"run.json", "timing.json", "labels.json", "coco.json", "layers.json"}) {
    INFO(gone);
    CHECK_FALSE(fs::exists(out / gone));
  }
  // What it had listed is a run's own still, and goes.
  must_render(out, "obstacle-field --frames 0 --products bscope --resume");
  CHECK_FALSE(fs::exists(out / "labels"));
  CHECK_FALSE(fs::exists(out / ".unfinished.json"));
  CHECK(files_told(out) == files_in(out));
}

TEST_CASE("Somebody's file with the name of a run's own is refused, and stays", "[render][fmcw]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  fs::create_directories(out);
  for (const char* name :
       {"radar.toml", "coco.json", "labels.json", "lard.csv", "layers.json", "timing.json"}) {
    std::ofstream(out / name) << "mine";
    for (const std::string command :
         {"fmcw street-76ghz --frames 0 --products detections",
          "render flat-grass --frames 0 --rays-per-cell 1 --products labels,layers"}) {
      const Result refused = run_fanbeam(command + " -q -o " + quoted(out));
      INFO(refused.output);
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.find(std::string("holds ") + name) != std::string::npos);
      CHECK(files_in(out) == std::vector<std::string>{name});
    }
    CHECK(bytes_of(out / name) == "mine");
    fs::remove(out / name);
  }
  // What is listed is a run's own.
  must_render(out, "flat-grass --frames 0 --products labels,layers");
  CHECK(files_told(out) == files_in(out));
  must_render(out, "flat-grass --frames 0 --products bscope --effects none");
  CHECK_FALSE(fs::exists(out / "coco.json"));
}

TEST_CASE("Files of all frames are a killed run's own by its note alone", "[render]") {
  const TemporaryFolder folder;
  const auto there = [&] { return session::OutputFolder(folder.path(), "", false); };
  session::OutputFolder killed = there();
  killed.begin({}, {"coco.json"});
  folder.write("coco.json", "half a run's");
  CHECK_NOTHROW(there());
  there().keep_only({});
  CHECK_FALSE(fs::exists(folder.path() / "coco.json"));
  folder.write("lard.csv", "mine");
  CHECK_THROWS_AS(there(), core::InputError);
  fs::remove(folder.path() / "lard.csv");
  killed.end();
  folder.write("coco.json", "mine");
  CHECK_THROWS_AS(there(), core::InputError);
}

// It went with the first frame that was made, as files of fmcw do not say their input.
TEST_CASE("The record of a run comes back where the next one wrote nothing, also without inputs",
          "[fmcw]") {
  const TemporaryFolder folder;
  for (const char* product : {"detections", "beat"}) fs::create_directory(folder.path() / product);
  folder.write("run.json", R"({"frames": [{"files": ["detections/00000.csv"]}],)"
                           R"( "files": ["radar.toml"]})");
  for (const char* name : {"timing.json", "radar.toml", "detections/00000.csv"})
    folder.write(name, "of the first run");
  const auto before = contents(folder.path());
  {
    session::OutputFolder failed(folder.path(), "", false);
    failed.begin({"detections", "beat"}, {"radar.toml"});
    CHECK_FALSE(fs::exists(folder.path() / "run.json"));
    CHECK_FALSE(fs::exists(folder.path() / "radar.toml"));
  }
  CHECK((contents(folder.path()) == before));
  {
    session::OutputFolder failed(folder.path(), "", false);
    failed.begin({"detections", "beat"}, {"radar.toml"});
    folder.write("beat/00007.npy", "of the second run");
  }
  for (const char* gone : {"run.json", "timing.json", "radar.toml"})
    CHECK_FALSE(fs::exists(folder.path() / gone));
  CHECK_NOTHROW(session::OutputFolder(folder.path(), "", false));
}

// Its note held nothing but what the record had listed, and a film alone told no input.
TEST_CASE("A killed run of another input leaves only what the next run may replace", "[render]") {
  const TemporaryFolder folder;
  for (const char* product : {"bscope", "cscope"}) fs::create_directory(folder.path() / product);
  folder.write("run.json", R"({"frames": [], "files": ["preview.mp4"]})");
  folder.write("preview.mp4", "of the first run");
  session::OutputFolder killed(folder.path(), "second input", false);
  killed.begin_frames([] { return std::set<std::string>{"cscope/00003.png", "cscope/00004.png"}; });
  CHECK_FALSE(fs::exists(folder.path() / "run.json"));
  folder.write("cscope/00003.png", "of the second run");
  CHECK_NOTHROW(session::OutputFolder(folder.path(), "third input", false));
  for (const char* name : {"bscope/00003.png", "cscope/00005.png", "cscope/00003_mine.png"}) {
    folder.write(name, "somebody's");
    CHECK_THROWS_AS(session::OutputFolder(folder.path(), "third input", false), core::InputError);
    fs::remove(folder.path() / name);
  }
  // Films go on the same note.
  killed.begin({}, {"preview.gif"});
  folder.write("preview.gif", "of the second run");
  CHECK_NOTHROW(session::OutputFolder(folder.path(), "third input", false));
}

// At its end a part removed whatever had come since it had looked for frames to list, and the other
// part listed what was gone.
TEST_CASE("A part that ends keeps the frames that another part writes meanwhile", "[render]") {
  for (const bool overwrite : {false, true}) {
    INFO(overwrite);
    const TemporaryFolder folder;
    const auto write = [&](const std::string& product, int index, const std::string& input) {
      fs::create_directories(folder.path() / product);
      for (const std::string& name : session::frame_files({product}, index)) {
        const fs::path file = folder.path() / name;
        if (file.extension() == ".json")
          folder.write(name, R"({"metadata": {"fanbeam:input": ")" + input + R"("}})");
        else
          core::write_png(file, {1, 1, {0}}, {{"fanbeam:input", input}});
      }
    };
    for (int index = 0; index < 4; ++index) {
      write("bscope", index, "first input");
      write("labels", index, "first input");
    }
    folder.write("run.json",
                 R"({"frames": [{"files": ["bscope/00000.png", "bscope/00001.png",)"
                 R"("bscope/00002.png", "bscope/00003.png", "labels/00000.json",)"
                 R"("labels/00001.json", "labels/00002.json", "labels/00003.json"]}]})");
    session::OutputFolder part(folder.path(), "second input", overwrite);
    part.begin_frames([] { return std::set<std::string>{"bscope/00003.png"}; });
    write("bscope", 3, "second input");
    write("bscope", 0, "second input");  // the other part's
    const auto listed = part.frames({{3, {"bscope"}}});
    CHECK((listed == std::map<int, std::set<std::string>>{{0, {"bscope"}}, {3, {"bscope"}}}));
    write("bscope", 1, "second input");  // now it goes on
    write("labels", 1, "second input");
    CHECK(part.keep_only({"bscope/00000.png", "bscope/00003.png"}) == 3);  // 0, 2 and 3, in part
    part.end();
    CHECK(files_in(folder.path()) ==
          std::vector<std::string>{"bscope/00000.png", "bscope/00001.png", "bscope/00003.png",
                                   "labels/00001.json"});
  }
}

TEST_CASE("A frame that fmcw refuses leaves no folder", "[fmcw]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  // Of ramps far apart the street's cars fold.
  CHECK(run_fanbeam("fmcw street-76ghz -q --frames 0 --interval 200 --refuse-folding -o " +
                    quoted(out))
            .exit_code == 3);
  CHECK_FALSE(fs::exists(out));
}

// It was told when the first picture was to be written, and which option had named it was not.
TEST_CASE("A file in the place of the output folder is told before anything is made", "[render]") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("plain", "");
  const fs::path table =
      folder.write("det.csv", "time_s,range_m,radial_speed_mps,azimuth_deg\n0,10,1,2\n");
  for (const fs::path& place : {file, file / "below"})
    for (const std::string& words :
         {std::string("render flat-grass --frames 0"), "track " + quoted(table)}) {
      const Result told = run_fanbeam(words + " -o " + quoted(place));
      INFO(words << ": " << told.output);
      CHECK(told.exit_code == 4);
      CHECK(told.output.find("E-IO --output = \"" + place.string() + "\": expected a folder") !=
            std::string::npos);
      CHECK(told.output.find("frames/s") == std::string::npos);
    }
  CHECK(fs::is_regular_file(file));
}
