// What fanbeam track refuses of its inputs and of options that do not belong to them, and gaps between frames.
#include <fmt/format.h>

#include <complex>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "core/constants.h"
#include "core/npy.h"
#include "session/signal/detection_file.h"
#include "session/signal/radar.h"
#include "session/signal/radar_file.h"
#include "tests/apps/program.h"
#include "tests/needed_program.h"

using namespace fanbeam;
using tests::track;
namespace fs = std::filesystem;

namespace {

constexpr const char* kRadar = R"([waveform]
kind = "chirp-sequence"
frequency_GHz = 76
bandwidth_MHz = 250
chirps = 16
sample_rate_MHz = 4
[array]
transmitters = 1
receivers = 4
[receiver]
noise_figure_dB = 12
)";

std::string car(int first, int last, double begin_s) {
  std::string rows;
  for (int i = first; i < last; ++i)
    rows += fmt::format("{},{},-8,5\n", begin_s + 0.1 * i, 60.0 - 0.8 * i);
  return rows;
}

constexpr const char* kTableHead = "time_s,range_m,radial_speed_mps,azimuth_deg\n";

}  // namespace

TEST_CASE("A track does not live through half a minute without frames", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv =
      folder.write("gap.csv", kTableHead + car(0, 10, 0.0) + "30,200,1,-40\n30.1,200.1,1,-40\n");
  REQUIRE(track(csv, folder.path() / "out").exit_code == 0);
  const std::string tracks = tests::bytes_of(folder.path() / "out/tracks.csv");
  CHECK(tracks.find("\n0.9,1,") != std::string::npos);
  CHECK(tracks.find("\n30,1,") == std::string::npos);
  CHECK(tracks.find("\n30,2,") != std::string::npos);
}

// With nine digits 40 frames of Unix time had one: 1.76436e+09.
TEST_CASE("Tables of tracks have the times of their input, Unix time too", "[track]") {
  const tests::TemporaryFolder folder;
  const std::string rows = car(0, 20, 1764360000.0);
  const auto run = track(folder.write("car.csv", kTableHead + rows), folder.path() / "out");
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  for (const char* table : {"out/tracks.csv", "out/measurements.csv"}) {
    std::istringstream told(tests::bytes_of(folder.path() / table));
    std::string row;
    std::getline(told, row);
    std::set<std::string> times;
    while (std::getline(told, row)) times.insert(row.substr(0, row.find(',') + 1));
    CHECK(times.size() == 20);
    for (const std::string& time : times) CHECK(rows.find(time) != std::string::npos);
  }
}

TEST_CASE("Plots of an earlier run do not stay beside other tables", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const fs::path out = folder.path() / "out";
  REQUIRE(track(csv, out).exit_code == 0);
  nlohmann::json record = tests::json_of(out / "run.json");
  CHECK(record["plots"].empty());
  record["plots"] =
      nlohmann::json::array({"ranges.svg", "ranges.png", "plan.png", "notes.png", "../car.csv"});
  folder.write("out/run.json", record.dump());
  for (const char* name : {"ranges.svg", "ranges.png", "plan.png", "notes.png"})
    folder.write(std::string("out/") + name, "of another run");
  REQUIRE(track(csv, out).exit_code == 0);
  for (const char* name : {"ranges.svg", "ranges.png", "plan.png"})
    CHECK_FALSE(fs::exists(out / name));
  CHECK(fs::exists(out / "notes.png"));
  CHECK(fs::exists(csv));
}

// They went by their names alone, in a folder that no run had written to.
TEST_CASE("Pictures of somebody's that are called like plots stay", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  for (const char* name : {"plan.png", "ranges.svg"}) folder.write(name, "mine");
  // In the first run there is no record, in the second one that lists none.
  for (int run = 0; run < 2; ++run) {
    REQUIRE(track(csv, folder.path()).exit_code == 0);
    for (const char* name : {"plan.png", "ranges.svg"})
      CHECK(tests::bytes_of(folder.path() / name) == "mine");
  }
}

TEST_CASE("Plots that a run drew are listed in its record, and go with the next", "[track]") {
  if (!tests::needed_program("gnuplot")) return;
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const fs::path out = folder.path() / "out";
  const std::vector<std::string> plots = {"plan.png", "plan.svg", "ranges.png", "ranges.svg"};
  REQUIRE(track(csv, out, "--plots").exit_code == 0);
  CHECK(tests::json_of(out / "run.json")["plots"] == nlohmann::json(plots));
  for (const std::string& name : plots) CHECK(fs::exists(out / name));
  REQUIRE(track(csv, out).exit_code == 0);
  CHECK(tests::json_of(out / "run.json")["plots"].empty());
  for (const std::string& name : plots) CHECK_FALSE(fs::exists(out / name));
}

TEST_CASE("JSON frames of one time are one frame, and all that go back are told", "[track]") {
  const tests::TemporaryFolder folder;
  const std::string one =
      R"({"time_s": 0, "detections": [{"range_m": 50, "radial_speed_mps": 1, "azimuth_rad": 0}]})";
  const fs::path same =
      folder.write("same.json", R"({"frames": [)" + one + "," + one + "," + one + "]}");
  REQUIRE(track(same, folder.path() / "out").exit_code == 0);
  const nlohmann::json record = tests::json_of(folder.path() / "out/run.json");
  CHECK(record["frames"] == 1);
  CHECK(record["confirmed_tracks"] == 0);
  const auto at = [](int s) { return fmt::format(R"({{"time_s": {}, "detections": []}})", s); };
  const auto run =
      track(folder.write("back.json", R"({"frames": [)" + at(3) + "," + at(2) + "," + at(1) + "]}"),
            folder.path() / "back");
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("frame 1 time_s = 2") != std::string::npos);
  CHECK(run.output.find("frame 2 time_s = 1") != std::string::npos);
}

TEST_CASE("JSON detections have the members of the format alone, and one velocity", "[track]") {
  const tests::TemporaryFolder folder;
  const auto problems_of = [&](const std::string& frame) {
    core::ProblemList problems;
    session::read_detections(folder.write("one.json", frame), problems);
    return problems.all();
  };
  const std::string tail = R"("time_s": 0, "detections": []})";
  const auto misspelt = problems_of(R"({"radar_velocty_mps": [20, 0], )" + tail);
  REQUIRE(misspelt.size() == 1);
  CHECK(misspelt[0].code == "E-REF");
  CHECK(misspelt[0].field == "/radar_velocty_mps");
  CHECK(misspelt[0].expected.find("perhaps radar_velocity_mps") != std::string::npos);
  CHECK(problems_of(R"({"frames": [], "radar_speed_mps": 20})").size() == 1);
  CHECK(problems_of(R"({"time_s": 0, "detections": [{"range_m": 50, "radial_speed_mps": 1,
                        "azimuth_rad": 0, "snr": 20}]})")
            .size() == 1);
  // The speed over ground holds what the velocity lacks, and no less than it has.
  CHECK(problems_of(R"({"radar_velocity_mps": [3, -4], "radar_speed_mps": 5, "frame": 7, )" + tail)
            .empty());
  CHECK(problems_of(R"({"radar_velocity_mps": [3, -4], "radar_speed_mps": 9, )" + tail).empty());
  const auto contrary =
      problems_of(R"({"radar_velocity_mps": [30, 0], "radar_speed_mps": 3, )" + tail);
  REQUIRE(contrary.size() == 1);
  CHECK(contrary[0].field == "/radar_speed_mps");
}

// A row with a wrong cell was passed over, its time too.
TEST_CASE("Times of a table that go back are told beside what else is wrong with its rows",
          "[track]") {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  session::read_detections(
      folder.write("back.csv",
                   "time_s,range_m,radial_speed_mps,azimuth_deg\n0,10,1,2\n0.1,-10,1,2\n"
                   "0.05,12,1,2\nx,12,1,2\n0.2,12,1,2\n0.15,-3,1,2\n"),
      problems);
  std::vector<std::string> told;
  for (const core::Problem& problem : problems.all())
    told.push_back(std::to_string(problem.place.line) + " " + problem.code);
  CHECK(told ==
        std::vector<std::string>{"3 E-RANGE", "4 E-TIME", "5 E-PARSE", "7 E-RANGE", "7 E-TIME"});
}

// Two cars 5 m apart, each cluster 0 of its radar's frame, were one measurement between them.
TEST_CASE("Clusters of two frames of one time stay apart", "[track]") {
  const tests::TemporaryFolder folder;
  const auto frame = [](double range_m, int first, int second) {
    const auto part = [&](double beyond_m, int cluster) {
      return fmt::format(
          R"({{"range_m": {}, "radial_speed_mps": 1, "azimuth_rad": 0, "cluster": {}}})",
          range_m + beyond_m, cluster);
    };
    return R"({"time_s": 0, "detections": [)" + part(0.0, first) + "," + part(0.5, first) + "," +
           part(20.0, second) + "]}";
  };
  core::ProblemList problems;
  const auto frames = session::read_detections(
      folder.write("two.json", R"({"frames": [)" + frame(30.0, 0, -1) + "," + frame(35.0, 0, 7) +
                                   "," + frame(40.0, 1000000000, 0) + "]}"),
      problems);
  CHECK_FALSE(problems.has_errors());
  REQUIRE(frames.size() == 1);
  CHECK(frames[0].detections.size() == 9);
  CHECK(frames[0].clusters == std::vector<int>{0, 0, -1, 1, 1, 2, 3, 3, 4});
}

TEST_CASE("Elevations are read from tables and from JSON, and lie within a quarter turn",
          "[track]") {
  const tests::TemporaryFolder folder;
  core::ProblemList problems;
  const fs::path csv = folder.write(
      "car.csv", "time_s,range_m,radial_speed_mps,azimuth_deg,elevation_deg\n0,50,1,0,30\n");
  const auto in_table = session::read_detections(csv, problems);
  REQUIRE(in_table.size() == 1);
  CHECK(in_table[0].detections.at(0).elevation_rad == Approx(core::kPi / 6.0));
  const std::string one = R"({"range_m": 50, "radial_speed_mps": 1, "azimuth_rad": 0)";
  const fs::path json = folder.write("car.json", R"({"time_s": 0, "detections": [)" + one +
                                                     R"(, "elevation_rad": -0.2}, )" + one + "}]}");
  const auto in_json = session::read_detections(json, problems);
  REQUIRE(in_json.size() == 1);
  CHECK(in_json[0].detections.at(0).elevation_rad == Approx(-0.2));
  CHECK(in_json[0].detections.at(1).elevation_rad == 0.0);
  CHECK_FALSE(problems.has_errors());
  session::read_detections(
      folder.write("high.csv",
                   "time_s,range_m,radial_speed_mps,azimuth_deg,elevation_deg\n0,50,1,0,91\n"),
      problems);
  CHECK(problems.has_errors());
}

TEST_CASE("Options of another kind of input are refused by name", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const auto run = track(csv, folder.path() / "out",
                         "--frames 0:3 --samples --noise-figure 3 --frame-period 0.1");
  CHECK(run.exit_code == 2);
  for (const char* option : {"--frames", "--samples", "--noise-figure", "--frame-period"}) {
    INFO(option << " in\n" << run.output);
    CHECK(run.output.find(std::string(option) + " = given") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}

TEST_CASE("The record of another command is not written over", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const fs::path record = folder.write("run.json", R"({"command": "render"})");
  const auto refused = track(csv, folder.path());
  CHECK(refused.exit_code == 2);
  CHECK(refused.output.find("--output") != std::string::npos);
  CHECK(tests::bytes_of(record) == R"({"command": "render"})");
  REQUIRE(track(csv, folder.path() / "out").exit_code == 0);
  CHECK(track(csv, folder.path() / "out").exit_code == 0);
}

TEST_CASE("What contradicts itself in a radar file is the file's fault", "[track]") {
  const tests::TemporaryFolder folder;
  std::string text = kRadar;
  text.insert(text.find("chirps = 16"), "slots = 3\n");
  const fs::path radar = folder.write("slots.toml", text);
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const auto run = track(csv, folder.path() / "out", "--radar " + tests::quoted(radar));
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("slots.toml: E-UNSUPPORTED waveform.slots = 3") != std::string::npos);
  const std::string fmcw = "fmcw street-76ghz -q -o " + tests::quoted(folder.path() / "fmcw") +
                           " --radar " + tests::quoted(radar);
  const auto signals = tests::run_fanbeam(fmcw);
  CHECK(signals.exit_code == 3);
  CHECK(signals.output.find("slots.toml: E-UNSUPPORTED waveform.slots = 3") != std::string::npos);
  // An option that mends it, and one that breaks it again.
  CHECK(tests::run_fanbeam(fmcw + " --slots 1").exit_code == 0);
  CHECK(tests::run_fanbeam(fmcw + " --slots 2").exit_code == 3);
}

TEST_CASE(
    "A radar without maps, or with fewer chirps than its detector looks over, is told as such",
    "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path radar = folder.write("triangle.toml",
                                      "[waveform]\nkind = \"triangle\"\nfrequency_GHz = 76\n"
                                      "bandwidth_MHz = 250\n[receiver]\nnoise_figure_dB = 10\n");
  const fs::path csv = folder.write("car.csv", kTableHead + car(0, 10, 0.0));
  const auto run = track(csv, folder.path() / "out", "--radar " + tests::quoted(radar));
  INFO(run.output);
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("triangle.toml: E-UNSUPPORTED waveform.kind = ") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  const std::string fmcw =
      "fmcw street-76ghz -q --chirps 8 -o " + tests::quoted(folder.path() / "fmcw");
  const auto few = tests::run_fanbeam(fmcw);
  INFO(few.output);
  CHECK(few.exit_code == 2);
  CHECK(few.output.find("--chirps = 8") != std::string::npos);
  CHECK(tests::run_fanbeam(fmcw + " --products beat").exit_code == 0);
}

TEST_CASE("A radar file's line may not contradict the places beside it", "[fmcw]") {
  const auto fields_of = [](const std::string& line) {
    session::FmcwSettings settings;
    core::ProblemList problems;
    session::read_radar_text(
        "[array]\ntransmitter_right_m = [0.0]\nreceiver_right_m = [0.0, 0.002]\n" + line,
        "radar.toml", settings, problems);
    std::vector<std::string> fields;
    for (const core::Problem& problem : problems.all()) fields.push_back(problem.field);
    return fields;
  };
  CHECK(fields_of("transmitters = 1\nreceivers = 2\n").empty());
  CHECK(fields_of("transmitters = 2\nreceivers = 4\n") ==
        std::vector<std::string>{"array.transmitters", "array.receivers"});
  CHECK(fields_of("pitch_wavelengths = 0.5\n") ==
        std::vector<std::string>{"array.pitch_wavelengths"});
}

TEST_CASE("Numbers of elements given as options replace a file's places", "[fmcw]") {
  const tests::TemporaryFolder folder;
  std::string text = kRadar;
  const std::string line = "transmitters = 1\nreceivers = 4\n";
  text.replace(text.find(line), line.size(),
               "transmitter_right_m = [0.0]\nreceiver_right_m = [0.0, 0.003, 0.007]\n");
  const fs::path radar = folder.write("places.toml", text), out = folder.path() / "out";
  const std::string fmcw =
      "fmcw street-76ghz -q -o " + tests::quoted(out) + " --radar " + tests::quoted(radar);
  REQUIRE(tests::run_fanbeam(fmcw).exit_code == 0);
  CHECK(tests::bytes_of(out / "radar.toml").find("0.007") != std::string::npos);
  REQUIRE(tests::run_fanbeam(fmcw + " --receivers 6").exit_code == 0);
  CHECK(tests::bytes_of(out / "radar.toml").find("receivers = 6") != std::string::npos);
  CHECK(tests::bytes_of(out / "radar.toml").find("0.007") == std::string::npos);
}

TEST_CASE("Whose range a spectrogram looks about is not taken without one", "[fmcw]") {
  const tests::TemporaryFolder folder;
  const auto run = tests::run_fanbeam("fmcw street-76ghz -q --spectrogram-of car -o " +
                                      tests::quoted(folder.path() / "out"));
  CHECK(run.exit_code == 2);
  CHECK(run.output.find("--products spectrogram") != std::string::npos);
}

TEST_CASE("What a B-scope alone does not look at is refused, all of it", "[fmcw]") {
  const tests::TemporaryFolder folder;
  const std::string out = " -o " + tests::quoted(folder.path() / "out");
  auto run = tests::run_fanbeam(
      "fmcw braunschweig-26 -q --products bscope --waveform triangle --cfar ca --transmitters 8" +
      out);
  INFO(run.output);
  CHECK(run.exit_code == 2);
  for (const char* option : {"--waveform", "--cfar", "--transmitters"})
    CHECK(run.output.find(option) != std::string::npos);
  run = tests::run_fanbeam("fmcw street-76ghz -q --products beat --looks 64" + out);
  CHECK(run.exit_code == 2);
  CHECK(run.output.find("--looks") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}

// Every cell was a detection, or a field that nobody had set was refused.
TEST_CASE("Guard cells within the windows' main lobe are refused where cells are detected",
          "[fmcw]") {
  const tests::TemporaryFolder folder;
  const std::string out = " -o " + tests::quoted(folder.path() / "out");
  for (const char* detector : {"--cfar os --cfar-guard 0", "--cfar go --cfar-guard 0,1"}) {
    const auto run = tests::run_fanbeam(std::string("fmcw street-76ghz -q --products detections ") +
                                        detector + out);
    INFO(run.output);
    CHECK(run.exit_code == 2);
    CHECK(run.output.find("--cfar-guard = 0,") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(folder.path() / "out"));
  const auto beat =
      tests::run_fanbeam("fmcw street-76ghz -q --products beat --chirps 16 --cfar-guard 0" + out);
  INFO(beat.output);
  CHECK(beat.exit_code == 0);
}

TEST_CASE("Real samples are not read as complex ones", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path radar = folder.write("radar.toml", kRadar);
  const std::vector<std::size_t> shape{1, 4, 16, 80};
  core::write_npy(folder.path() / "real.npy", shape, std::vector<double>(5120, 1.0));
  const auto run =
      track(folder.path() / "real.npy", folder.path() / "out", "--radar " + tests::quoted(radar));
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("<f8") != std::string::npos);
  CHECK(run.output.find("real = true") != std::string::npos);
}

// Taken apart as if they took turns, they gave three times the speed without a word.
TEST_CASE("Chirps of transmitters that send at once are not taken for each other's", "[track]") {
  const tests::TemporaryFolder folder;
  std::string text = kRadar;
  text.replace(text.find("transmitters = 1"), 16, "transmitters = 3");
  const fs::path radar =
      folder.write("radar.toml", text + "[samples]\naxes = \"frame, chirp, receiver, sample\"\n");
  core::write_npy(folder.path() / "turns.npy", {1, 48, 4, 80},
                  std::vector<std::complex<float>>(15360, {1e-6F, 0.0F}));
  const auto run =
      track(folder.path() / "turns.npy", folder.path() / "out", "--radar " + tests::quoted(radar));
  INFO(run.output);
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("1 along transmitter: expected 3, as the array has (waveform.slots") !=
        std::string::npos);
}

TEST_CASE("A radar file and detections that are wrong are told together", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path radar = folder.write("bad.toml", std::string(kRadar) + "colour = 1\n");
  const fs::path csv = folder.write("bad.csv", std::string(kTableHead) + "0,-3,1,0\n");
  const auto run = track(csv, folder.path() / "out", "--radar " + tests::quoted(radar));
  INFO(run.output);
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("bad.toml") != std::string::npos);
  CHECK(run.output.find("range_m = -3") != std::string::npos);
}

TEST_CASE("All files of samples are looked at before the first is tracked", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path radar = folder.write("radar.toml", kRadar), out = folder.path() / "out";
  fs::create_directory(folder.path() / "raw");
  const auto write = [&](int number, std::size_t channels, float value) {
    std::vector<std::complex<float>> samples(channels * 20 * 100, {1e-6F, 0.0F});
    samples.back() = value;
    core::write_npy(folder.path() / fmt::format("raw/frame_{}.npy", number), {channels, 20, 100},
                    samples);
  };
  const auto told = [&] {
    const auto run = track(folder.path() / "raw", out, "--radar " + tests::quoted(radar));
    INFO(run.output);
    CHECK(run.exit_code == 3);
    CHECK_FALSE(fs::exists(out));
    return run.output;
  };
  write(1, 4, 0.0F);
  for (const int bad : {2, 10}) write(bad, 3, 0.0F);
  folder.write("raw/frame_3.npy", "x");
  const std::string headers = told();
  for (const char* name : {"frame_2.npy", "frame_3.npy", "frame_10.npy"})
    CHECK(headers.find(name) != std::string::npos);
  for (const int number : {2, 3, 10})
    write(number, 4, number == 3 ? 0.0F : std::numeric_limits<float>::quiet_NaN());
  const std::string values = told();
  for (const char* name : {"frame_2.npy: E-NONFINITE", "frame_10.npy: E-NONFINITE"})
    CHECK(values.find(name) != std::string::npos);
  CHECK(values.find("frame_3.npy") == std::string::npos);
  for (const int number : {2, 10}) write(number, 4, 0.0F);
  write(3, 4, 3e38F);
  CHECK(told().find("frame_3.npy: E-RANGE value 7999 = 3") != std::string::npos);
}

// It was the map's NaN that was told, without file or value.
TEST_CASE("Samples that would overflow are refused, as they are with their scale", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path out = folder.path() / "out", samples = folder.path() / "one.npy";
  const auto run = [&](float value, const std::string& scale) {
    const fs::path radar =
        folder.write("radar.toml", kRadar + ("[samples]\nscale_sqrtW = " + scale + "\n"));
    std::vector<std::complex<float>> tone;
    for (int i = 0; i < 8000; ++i)
      tone.push_back(std::polar(value, 0.5F * static_cast<float>(i % 100)));
    core::write_npy(samples, {4, 20, 100}, tone);
    return track(samples, out, "--radar " + tests::quoted(radar));
  };
  for (const auto& [value, scale] : {std::pair{2e10F, "1"}, std::pair{20.0F, "1e9"}}) {
    const auto refused = run(value, scale);
    INFO(refused.output);
    CHECK(refused.exit_code == 3);
    CHECK(refused.output.find("one.npy: E-RANGE value 0 = ") != std::string::npos);
  }
  const auto taken = run(9.9e9F, "1");
  INFO(taken.output);
  CHECK(taken.exit_code == 0);
}

TEST_CASE("Places on a line have the pitch between them, whatever it is", "[fmcw]") {
  core::ProblemList problems;
  session::FmcwSettings settings;
  session::read_radar_text(R"([waveform]
frequency_GHz = 76
bandwidth_MHz = 250
slots = 1
sample_rate_MHz = 20
kind = "chirp-sequence"
[array]
transmitter_right_m = [0.0]
receiver_right_m = [0.0, 0.0028, 0.0056, 0.0084]
gain_errors_dB = [0, 1, -1, 0.5]
phase_errors_deg = [0, 10, 20, -30]
[receiver]
noise_figure_dB = 12
line_width_Hz = 500
adc_bits = 10
adc_full_scale_dBm = -30
)",
                           "radar.toml", settings, problems);
  REQUIRE_FALSE(problems.has_errors());
  const session::FmcwRadar radar = session::fmcw_radar(settings);
  CHECK(radar.line);
  CHECK(radar.pitch_m == Approx(0.0028));
  // A rate that nobody told was 1 MHz: every range a twentieth of what it is.
  session::FmcwSettings no_rate = settings;
  no_rate.numbers.fill(std::nullopt);
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i)
    if (std::string_view(session::kWaveformNumbers[i].option) != "--sample-rate")
      no_rate.numbers[i] = settings.numbers[i];
  CHECK_THROWS_WITH(session::check_tells_samples(no_rate),
                    Catch::Contains("waveform.sample_rate_MHz"));
  CHECK_NOTHROW(session::check_tells_samples(settings));
  // Of detections it tells nothing: the resolution is that of the sweep.
  CHECK(session::fmcw_radar(no_rate).axes.range_step_m == Approx(radar.axes.range_step_m));
  // Off a line no window is laid over the channels; one that is asked for was dropped.
  session::FmcwSettings bent = settings;
  bent.receivers_m[1].y += 1e-4;
  CHECK_FALSE(session::fmcw_radar(bent).line);
  bent.angle_window = {.kind = signal::WindowKind::hann, .symmetric = true};
  CHECK_THROWS_WITH(session::fmcw_radar(bent), Catch::Contains("angle window"));
  // What is wrong with the receiver is written too.
  session::FmcwSettings again;
  session::read_radar_text(
      session::radar_toml(settings, "chirp-sequence", {76e9, 250e6, std::pow(10.0, 1.2), 0.0}),
      "again.toml", again, problems);
  REQUIRE_FALSE(problems.has_errors());
  CHECK(again.gain_errors_dB == settings.gain_errors_dB);
  REQUIRE(again.phase_errors_rad.size() == 4);
  CHECK(again.phase_errors_rad[3] == Approx(settings.phase_errors_rad[3]));
  CHECK(again.line_width_Hz == 500.0);
  CHECK(again.adc_bits == 10);
  CHECK(again.adc_full_scale_dBm == -30.0);
}
