// fanbeam track on a scene's signals, recorded samples and detections; radar files.
#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <sstream>

#include "core/image.h"
#include "core/npy.h"
#include "session/signal/radar_file.h"
#include "session/signal/sample_file.h"
#include "tests/apps/program.h"
#include "tests/apps/same_tracks.h"

using namespace fanbeam;
using tests::track;
namespace fs = std::filesystem;

namespace {

// Its first frames, of which targets named with `what` were followed in how many.
int least_followed(const nlohmann::json& record, const std::string& what) {
  int least = 1'000'000;
  for (const auto& target : record["targets"])
    if (target["name"].get<std::string>().starts_with(what))
      least = std::min(least, target["followed"].get<int>());
  return least;
}

}  // namespace

TEST_CASE("A street is followed from its scene, its detections and its samples alike", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path made = folder.path() / "street", out = folder.path();
  auto result = tests::run_fanbeam(
      "fmcw street-76ghz -q --frames 0:12 --products beat,detections -o " + tests::quoted(made));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  result =
      tests::run_fanbeam("track street-76ghz -q --frames 0:12 -o " + tests::quoted(out / "scene"));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "scene/run.json");
  CHECK(record["kind"] == "scene");
  for (const char* name : {"car ahead", "oncoming car", "cyclist", "pedestrian, body"}) {
    INFO(name);
    CHECK(least_followed(record, name) >= 9);  // a track takes two frames to be told
  }
  CHECK(record["moving_tracks"] >= 4);
  // The folder's detections are those of the scene.
  REQUIRE(track(made, out / "detections").exit_code == 0);
  CHECK(tests::json_of(out / "detections/run.json")["kind"] == "detections");
  const std::string tracks = tests::bytes_of(out / "scene/tracks.csv");
  CHECK(tests::bytes_of(out / "detections/tracks.csv") == tracks);
  // So are its tables, as far as their digits go.
  tests::remove_json(made / "detections", 12);
  REQUIRE(track(made, out / "tables").exit_code == 0);
  tests::check_same_tracks(out / "detections", out / "tables");
  CHECK(tests::json_of(out / "tables/run.json")["resolution"]["of"] == "the radar");
  // Samples alone.
  fs::remove_all(made / "detections");
  REQUIRE(track(made, out / "samples", "--frame-period 0.05").exit_code == 0);
  const nlohmann::json samples = tests::json_of(out / "samples/run.json");
  CHECK(samples["kind"] == "samples");
  CHECK(samples["moving_tracks"] == record["moving_tracks"]);
}

// An azimuth known to a radian started no track: none was followed, without a word.
TEST_CASE("A radar of one element follows a street along the line of sight", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path radar = folder.path() / "radar.toml", out = folder.path() / "tracks";
  std::ofstream(radar) << "[array]\ntransmitters = 1\nreceivers = 1\n";
  const auto result = tests::run_fanbeam("track street-76ghz -q --plots --frames 0:6 --radar " +
                                         tests::quoted(radar) + " -o " + tests::quoted(out));
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "run.json");
  CHECK(record["range_only"] == true);
  for (const char* name : {"car ahead", "oncoming car", "cyclist", "pedestrian, body"}) {
    INFO(name);
    CHECK(least_followed(record, name) >= 3);
  }
  CHECK(record["moving_tracks"] >= 3);
  CHECK(fs::exists(out / "ranges.png"));
  CHECK_FALSE(fs::exists(out / "plan.png"));
}

TEST_CASE("Recorded cubes of another layout give the same tracks", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path made = folder.path() / "street", out = folder.path();
  REQUIRE(tests::run_fanbeam("fmcw street-76ghz -q --frames 0:4 --products beat --chirps 64 -o " +
                             tests::quoted(made))
              .exit_code == 0);
  // Its record tells times and speed, that of somebody's recorder does not.
  REQUIRE(track(made, out / "own", "--frame-period 0.05 --radar-speed 0").exit_code == 0);
  // As a recorder keeps it: frame, chirps of the three transmitters in turn, receiver, sample; another
  // sign of the beat, another unit.
  constexpr std::size_t kFrames = 4, kChirps = 64, kReceivers = 4, kTransmitters = 3;
  std::vector<std::complex<float>> recorded;
  std::size_t samples = 0;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const fs::path file = made / fmt::format("beat/{:05}.npy", frame);
    const core::NpyHeader header = core::read_npy_header(file);
    samples = header.shape[2];
    const auto values = core::read_npy(file, header, 0, header.count());
    for (std::size_t chirp = 0; chirp < kChirps * kTransmitters; ++chirp)
      for (std::size_t receiver = 0; receiver < kReceivers; ++receiver)
        for (std::size_t n = 0; n < samples; ++n) {
          const std::size_t channel = chirp % kTransmitters * kReceivers + receiver;
          recorded.push_back(
              1024.0F *
              std::conj(values[(channel * kChirps + chirp / kTransmitters) * samples + n]));
        }
  }
  const fs::path file = folder.path() / "recorded.npy";
  core::write_npy(file, {kFrames, kChirps * kTransmitters, kReceivers, samples}, recorded);
  const fs::path radar =
      folder.write("radar.toml", tests::bytes_of(made / "radar.toml") +
                                     "\n[samples]\naxes = \"frame, chirp, receiver, sample\"\n"
                                     "scale_sqrtW = 0.0009765625\nconjugate = true\n");
  const auto run = track(file, out / "recorded", "--radar " + tests::quoted(radar));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  CHECK(tests::bytes_of(out / "recorded/tracks.csv") == tests::bytes_of(out / "own/tracks.csv"));
  // Receivers that are out of true, as calibration knows them, are set right; and are not, without.
  const std::vector<double> gains_dB = {0, 1, -1, 2, 0, 0, 1, -2, 0, 1, 0, 0};
  const std::vector<double> phases_deg = {0, 30, -20, 50, 10, 0, -40, 20, 0, 90, -60, 15};
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const std::size_t row = i / samples,
                      channel = row / kReceivers % kTransmitters * kReceivers + row % kReceivers;
    recorded[i] *= static_cast<std::complex<float>>(std::polar(
        std::pow(10.0, 0.05 * gains_dB[channel]), phases_deg[channel] * core::kPi / 180.0));
  }
  const fs::path untrue = folder.path() / "untrue.npy";
  core::write_npy(untrue, {kFrames, kChirps * kTransmitters, kReceivers, samples}, recorded);
  const fs::path known = folder.write(
      "known.toml",
      tests::bytes_of(radar) + fmt::format("channel_gain_dB = [{}]\nchannel_phase_deg = [{}]\n",
                                           fmt::join(gains_dB, ", "), fmt::join(phases_deg, ", ")));
  const auto azimuths = [&](const fs::path& folder_of) {
    std::vector<double> result;
    std::istringstream rows(tests::bytes_of(folder_of / "measurements.csv"));
    std::string row, cell;
    for (std::getline(rows, row); std::getline(rows, row);) {
      std::istringstream cells(row);
      for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
      result.push_back(std::stod(cell));
    }
    return result;
  };
  REQUIRE(track(untrue, out / "set-right", "--radar " + tests::quoted(known)).exit_code == 0);
  REQUIRE(track(untrue, out / "as-it-is", "--radar " + tests::quoted(radar)).exit_code == 0);
  const std::vector<double> own = azimuths(out / "own"), right = azimuths(out / "set-right");
  REQUIRE(right.size() == own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    CHECK(right[i] == Approx(own[i]).epsilon(0.0).margin(1e-3));
  CHECK(azimuths(out / "as-it-is") != own);
  const fs::path few =
      folder.write("few.toml", tests::bytes_of(radar) + "channel_gain_dB = [1, 2]\n");
  const auto wrong = track(untrue, out / "refused", "--radar " + tests::quoted(few));
  CHECK(wrong.exit_code == 3);
  CHECK(wrong.output.find("one for each of 12 channels") != std::string::npos);
  // Another shape is told with what was expected.
  const fs::path short_axes =
      folder.write("short.toml", tests::bytes_of(made / "radar.toml") +
                                     "\n[samples]\naxes = \"frame, receiver, chirp, sample\"\n");
  const auto refused = track(file, out / "refused", "--radar " + tests::quoted(short_axes));
  CHECK(refused.exit_code == 3);
  CHECK(refused.output.find("4 along chirp: expected 192 or more") != std::string::npos);
  CHECK(refused.output.find("192 along receiver: expected 4") != std::string::npos);
  CHECK_FALSE(fs::exists(out / "refused"));
}

TEST_CASE("Tables of detections are refused with every wrong cell", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path csv = folder.write("bad.csv",
                                    "time_s,range_m,radial_speed_mps,azimuth_deg\n"
                                    "0,10,1,0\n0,-3,1,0\n0,10,nan,0\n0,10,1\n-1,10,1,0\n");
  auto run = track(csv, folder.path() / "out");
  CHECK(run.exit_code == 3);
  for (const char* told : {"bad.csv:3", "range_m = -3", "bad.csv:4", "E-NONFINITE", "bad.csv:5",
                           "3 cells", "bad.csv:6", "E-TIME"}) {
    INFO(told << " in\n" << run.output);
    CHECK(run.output.find(told) != std::string::npos);
  }
  run = track(folder.write("none.csv", "time_s,range\n"), folder.path() / "out");
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("radial_speed_mps = missing") != std::string::npos);
  run = track(folder.write("half.json", R"({"time_s": 0, "detections": [{"range_m": 1}]})"),
              folder.path() / "out");
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("/detections/0/azimuth_rad") != std::string::npos);
  run = track(folder.write("beat.npy", "x"), folder.path() / "out");
  CHECK(run.exit_code == 3);
  for (const char* told : {"--radar", "beat.npy"})
    CHECK(run.output.find(told) != std::string::npos);
}

TEST_CASE("A car by detections alone is followed without a radar", "[track]") {
  const tests::TemporaryFolder folder;
  std::string table = "time_s,range_m,radial_speed_mps,azimuth_deg\n";
  for (int i = 0; i < 20; ++i) table += fmt::format("{},{},-8,5\n", 0.1 * i, 60.0 - 0.8 * i);
  REQUIRE(track(folder.write("car.csv", table), folder.path() / "out").exit_code == 0);
  const nlohmann::json record = tests::json_of(folder.path() / "out/run.json");
  CHECK(record["confirmed_tracks"] == 1);
  CHECK(record["frame_s"].get<double>() == Approx(0.1));
  const std::string tracks = tests::bytes_of(folder.path() / "out/tracks.csv");
  CHECK(tracks.find(",existence,xx,") != std::string::npos);
}

TEST_CASE("Radar files read back as they were written, and tell all that is wrong", "[fmcw]") {
  const auto read = [](const std::string& text, core::ProblemList& problems) {
    session::FmcwSettings settings;
    session::read_radar_text(text, "radar.toml", settings, problems);
    return settings;
  };
  core::ProblemList problems;
  const session::FmcwSettings settings = read(R"(
[waveform]
kind = "chirp-sequence"
frequency_GHz = 77
bandwidth_MHz = 300
chirps = 32
[array]
transmitter_right_m = [0, 0.0077]
transmitter_up_m = [0, 0.0019]
receiver_right_m = [0, 0.0019, 0.0039, 0.0058]
[receiver]
noise_figure_dB = 12
phase_noise_offsets_kHz = [100, 1000]
phase_noise_dBc_per_Hz = [-85, -105]
[processing]
range_window = "kaiser:8"
cfar = "go"
cfar_training = [6, 0]
angle_method = "beamforming"
most_range_m = 90
)",
                                              problems);
  REQUIRE_FALSE(problems.has_errors());
  CHECK(settings.transmitters_m[1].z == 0.0019);
  CHECK(settings.phase_noise.offsets_Hz == std::vector<double>{1e5, 1e6});
  CHECK(settings.cfar == signal::CfarKind::greatest_of);
  const std::string text =
      session::radar_toml(settings, settings.waveform, {77e9, 300e6, std::pow(10.0, 1.2), 18e6});
  const session::FmcwSettings again = read(text, problems);
  REQUIRE_FALSE(problems.has_errors());
  CHECK(session::radar_toml(again, again.waveform, {77e9, 300e6, std::pow(10.0, 1.2), 0.0}) ==
        text);
  CHECK(again.receivers_m == settings.receivers_m);
  CHECK(again.range_window == settings.range_window);
  CHECK(again.most_range_m == settings.most_range_m);
  read(R"(
[waveform]
kind = "chirps"
ramp_us = -1
[array]
transmitter_right_m = [0.0]
[receiver]
line_width_Hz = 10
phase_noise_offsets_kHz = [100, 100]
phase_noise_dBc_per_Hz = [-85, -85]
[samples]
axes = "chirp, chirp, sample"
[processing]
angle_window = "boxcar"
cfar_guard = [1.5, 2]
cluster_plaice_m = 3
)",
       problems);
  std::string told;
  for (const core::Problem& problem : problems.all()) told += to_string(problem) + "\n";
  for (const char* wrong : {"waveform.kind", "ramp_us", "receiver_right_m", "not rising", "axes",
                            "boxcar", "1.5", "cluster_plaice_m"}) {
    INFO(wrong << " in\n" << told);
    CHECK(told.find(wrong) != std::string::npos);
  }
}

TEST_CASE("A scene's own radar file is used, below what the command line says", "[fmcw]") {
  const tests::TemporaryFolder folder;
  const auto made = [&](const char* name, const std::string& words) {
    const fs::path out = folder.path() / name;
    const auto run = tests::run_fanbeam("fmcw highway-76ghz -q --frames 5 --products detections " +
                                        words + " -o " + tests::quoted(out));
    INFO(run.output);
    REQUIRE(run.exit_code == 0);
    return tests::json_of(out / "run.json");
  };
  const nlohmann::json own = made("own", "");
  CHECK(own["array"]["multiplex"] == "simultaneous");
  CHECK(own["frames"][0]["warnings"].empty());  // nothing folds
  const nlohmann::json more = made("more", "--chirps 64 --cfar ca");
  CHECK(more["array"]["multiplex"] == "simultaneous");
  CHECK(more["axes"]["speed_cells"] == 64);
  CHECK(more["cfar"]["kind"] == "CA");
  const nlohmann::json other =
      made("other", "--radar " + tests::quoted(folder.write("r.toml", "[array]\nreceivers = 8\n")));
  CHECK(other["array"]["receivers"] == 8);
  CHECK(other["array"]["multiplex"] == "time-division");
}

// Without their own speed in them the posts of the guard rails would be told to move, all of them.
TEST_CASE("Detections that fmcw left tell the radar's speed, and the posts of a motorway stand",
          "[fmcw][track]") {
  const tests::TemporaryFolder folder;
  const fs::path signals = folder.path() / "signals", tracks = folder.path() / "tracks";
  REQUIRE(tests::run_fanbeam("fmcw highway-76ghz -q --frames 0:12 --products detections -o " +
                             tests::quoted(signals))
              .exit_code == 0);
  const auto track = [&](const std::string& words) {
    const auto run = tests::run_fanbeam("track " + tests::quoted(signals) + " -q -o " +
                                        tests::quoted(tracks) + " " + words);
    INFO(run.output);
    REQUIRE(run.exit_code == 0);
    return tests::json_of(tracks / "run.json");
  };
  const nlohmann::json told = track("");
  CHECK(told["radar_speed_mps"].get<double>() == Approx(100.0 / 3.6).epsilon(0.0).margin(0.01));
  REQUIRE(told["confirmed_tracks"] > 40);
  CHECK(told["moving_tracks"].get<int>() >= 6);
  CHECK(told["moving_tracks"].get<int>() <= 12);
  // Tables do not; fmcw's record beside them does.
  fs::rename(tracks, folder.path() / "of-json");
  tests::remove_json(signals / "detections", 12);
  track("");
  tests::check_same_tracks(folder.path() / "of-json", tracks);
  const nlohmann::json standing = track("--radar-speed 0");
  CHECK(standing["moving_tracks"].get<int>() > standing["confirmed_tracks"].get<int>() / 2);
}

// With its speed taken along the antenna's axis every post was told 21 m/s over ground.
TEST_CASE("A radar that looks askance has its own velocity in its axes, and posts stand",
          "[fmcw][track]") {
  const tests::TemporaryFolder folder;
  const fs::path askance = folder.path() / "askance", out = folder.path() / "tracks";
  fs::copy(FANBEAM_SOURCE_DIR "/scenes/highway-76ghz", askance, fs::copy_options::recursive);
  std::string text = tests::bytes_of(askance / "scene.toml");
  const std::string signal = "signal = \"radar.toml\"\n";
  REQUIRE(text.find(signal) != std::string::npos);
  text.insert(text.find(signal) + signal.size(), "yaw_deg = 45.0\n");
  std::ofstream(askance / "scene.toml") << text;
  const double along_mps = 100.0 / 3.6 * std::sqrt(0.5);
  const auto told = [&](double forward_mps, double right_mps) {
    const nlohmann::json record = tests::json_of(out / "run.json");
    CHECK(record["radar_velocity_mps"][0].get<double>() ==
          Approx(forward_mps).epsilon(0.0).margin(0.01));
    CHECK(record["radar_velocity_mps"][1].get<double>() ==
          Approx(right_mps).epsilon(0.0).margin(0.01));
    CHECK(record["radar_speed_mps"].get<double>() == Approx(100.0 / 3.6).epsilon(0.0).margin(0.01));
    return record;
  };
  REQUIRE(track(askance, out, "--frames 0:12").exit_code == 0);
  const nlohmann::json record = told(along_mps, -along_mps);
  REQUIRE(record["confirmed_tracks"] > 10);
  CHECK(record["moving_tracks"].get<int>() < record["confirmed_tracks"].get<int>() / 2);
  // Detections have it beside them, samples from the record of fmcw; an old record tells the speed alone.
  const fs::path signals = folder.path() / "signals";
  REQUIRE(tests::run_fanbeam("fmcw " + tests::quoted(askance) +
                             " -q --frames 0 --products beat,detections -o " +
                             tests::quoted(signals))
              .exit_code == 0);
  REQUIRE(track(signals, out).exit_code == 0);
  CHECK(told(along_mps, -along_mps)["kind"] == "detections");
  fs::remove_all(signals / "detections");
  REQUIRE(track(signals, out).exit_code == 0);
  CHECK(told(along_mps, -along_mps)["kind"] == "samples");
  nlohmann::json old = tests::json_of(signals / "run.json");
  REQUIRE(old["frames"][0].erase("radar_velocity_mps") == 1);
  std::ofstream(signals / "run.json") << old.dump();
  REQUIRE(track(signals, out).exit_code == 0);
  told(100.0 / 3.6, 0.0);
}

// Every second frame of a radar that drives: 0.05 s a frame and a radar at rest would be taken else.
TEST_CASE("Samples that fmcw left have the times and the speed that its record tells",
          "[fmcw][track]") {
  const tests::TemporaryFolder folder;
  const fs::path signals = folder.path() / "signals", out = folder.path() / "tracks";
  REQUIRE(tests::run_fanbeam("fmcw highway-76ghz -q --frames 2:8:2 --products beat -o " +
                             tests::quoted(signals))
              .exit_code == 0);
  const nlohmann::json frames = tests::json_of(signals / "run.json").at("frames");
  const double first_s = frames[0]["time_s"], last_s = frames[2]["time_s"];
  REQUIRE(last_s > first_s);
  REQUIRE(track(signals, out).exit_code == 0);
  const nlohmann::json record = tests::json_of(out / "run.json");
  CHECK(record["frame_s"].get<double>() == Approx(0.5 * (last_s - first_s)).epsilon(1e-12));
  CHECK(record["radar_speed_mps"].get<double>() == Approx(100.0 / 3.6).epsilon(0.0).margin(0.01));
  std::istringstream rows(tests::bytes_of(out / "measurements.csv"));
  std::set<double> times_s;
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) times_s.insert(std::stod(row));
  REQUIRE(times_s.size() == 3);
  CHECK(*times_s.begin() == Approx(first_s).epsilon(0.0).margin(1e-6));
  CHECK(*times_s.rbegin() == Approx(last_s).epsilon(0.0).margin(1e-6));
  // A file by its name alone, from within its folder, has its time and speed too.
  const auto within =
      tests::run_fanbeam("track 00004.npy -q --radar ../radar.toml -o " + tests::quoted(out),
                         "cd " + tests::quoted(signals / "beat") + " &&");
  INFO(within.output);
  REQUIRE(within.exit_code == 0);
  CHECK(tests::json_of(out / "run.json")["radar_speed_mps"].get<double>() ==
        Approx(100.0 / 3.6).epsilon(0.0).margin(0.01));
  // A record that is cut, or that does not name a file, is told; then 0.05 s count.
  const std::string whole = tests::bytes_of(signals / "run.json");
  fs::copy_file(signals / "beat/00006.npy", signals / "beat/00007.npy");
  for (const bool cut : {false, true}) {
    if (cut) {
      std::ofstream(signals / "run.json") << whole.substr(0, whole.size() / 2);
      fs::remove(signals / "beat/00007.npy");
    }
    const auto told =
        tests::run_fanbeam("track " + tests::quoted(signals) + " -o " + tests::quoted(out));
    INFO(told.output);
    REQUIRE(told.exit_code == 0);
    CHECK(told.output.find("W-TIMES") != std::string::npos);
    CHECK(tests::json_of(out / "run.json")["frame_s"] == 0.05);
  }
  std::ofstream(signals / "run.json") << whole;
  // An option goes before the record.
  REQUIRE(track(signals, out, "--frame-period 0.2 --radar-speed 3").exit_code == 0);
  CHECK(tests::json_of(out / "run.json")["frame_s"] == 0.2);
  CHECK(tests::json_of(out / "run.json")["radar_speed_mps"] == 3.0);
}

TEST_CASE("A car's radar in a scene raises the floor, and mending recovers detections", "[fmcw]") {
  const tests::TemporaryFolder folder;
  fs::copy(FANBEAM_SOURCE_DIR "/scenes/street-76ghz", folder.path() / "street",
           fs::copy_options::recursive);
  const auto add = [&](const std::string& text) {
    std::ofstream(folder.path() / "street/scene.toml", std::ios::app) << text;
  };
  add("\n[[interferer]]\ntarget = \"oncoming car, plate\"\neirp_dBm = 35\nfalling = true\n"
      "ramp_us = 23\ninterval_us = 31\nstart_us = 4\n");
  const fs::path out = folder.path() / "out";
  auto run = tests::run_fanbeam("fmcw " + tests::quoted(folder.path() / "street") +
                                " -q --chirps 32 --products interference -o " + tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  std::istringstream table(tests::bytes_of(out / "interference/00000.csv"));
  std::string line;
  std::map<std::string, std::vector<double>> rows;
  std::getline(table, line);
  CHECK(line ==
        "case,floor_dBm,rise_dB,mended_samples,detections,recovered,missed,false_detections");
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::string name, cell;
    std::getline(cells, name, ',');
    while (std::getline(cells, cell, ',')) rows[name].push_back(std::stod(cell));
  }
  REQUIRE(rows.size() == 4);
  CHECK(rows["none"][1] > 3.0);
  CHECK(rows["zero"][1] < 1.0);
  CHECK(rows["interpolate"][1] < 1.0);
  CHECK(rows["none"][4] < rows["zero"][4]);
  CHECK(rows["interpolate"][4] >= 0.95 * rows["clean"][4]);
  CHECK(tests::json_of(out / "run.json")["frames"][0]["crossed"] > 100);
  add("\n[[interferer]]\ntarget = \"nobody\"\neirp_dBm = 35\ninterval_us = 3\n");
  run = tests::run_fanbeam("validate " + tests::quoted(folder.path() / "street"));
  CHECK(run.exit_code == 3);
  CHECK(run.output.find("interferer[1].target = \"nobody\": expected the name of a [[target]] that "
                        "carries it; there are ") != std::string::npos);
  CHECK(run.output.find("interval_us") != std::string::npos);
}

TEST_CASE("A radar too faint to be seen is left out by the plan, and changes no byte", "[fmcw]") {
  const tests::TemporaryFolder folder;
  fs::copy(FANBEAM_SOURCE_DIR "/scenes/street-76ghz", folder.path() / "street",
           fs::copy_options::recursive);
  const auto made = [&](const char* name, const std::string& words) {
    const fs::path out = folder.path() / name;
    const auto run =
        tests::run_fanbeam("fmcw " + tests::quoted(folder.path() / "street") +
                           " -q --frames 0 --chirps 32 --products detections,range-doppler " +
                           words + " -o " + tests::quoted(out));
    INFO(run.output);
    REQUIRE(run.exit_code == 0);
    return out;
  };
  const auto decision = [](const fs::path& out) {
    const nlohmann::json frame = tests::json_of(out / "run.json")["frames"][0];
    for (const nlohmann::json& row : frame["plan"])
      if (row["effect"] == "interference") return row;
    return nlohmann::json();
  };
  const fs::path none = made("none", "");
  CHECK(decision(none)["reason"].get<std::string>().find("no [[interferer]]") == 0);
  std::ofstream(folder.path() / "street/scene.toml", std::ios::app)
      << "\n[[interferer]]\ntarget = \"oncoming car, plate\"\neirp_dBm = -60\nfalling = true\n"
         "ramp_us = 23\ninterval_us = 31\nstart_us = 4\n";
  const fs::path faint = made("faint", ""), forced = made("forced", "--effects +interference");
  CHECK_FALSE(decision(faint)["on"].get<bool>());
  CHECK(decision(faint)["bound_grey"].get<double>() > 0.0);
  for (const char* file : {"detections/00000.csv", "range-doppler/00000.exr"})
    CHECK(tests::bytes_of(faint / file) == tests::bytes_of(none / file));
  CHECK(decision(forced)["on"].get<bool>());
  CHECK(tests::bytes_of(forced / "range-doppler/00000.exr") !=
        tests::bytes_of(none / "range-doppler/00000.exr"));
}

TEST_CASE("A pedestrian's legs swing about the body in the spectrogram", "[fmcw]") {
  const tests::TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  auto run = tests::run_fanbeam(
      "fmcw street-76ghz -q --frames 16:32 --products spectrogram --spectrogram-of pedestrian -o " +
      tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const core::Image image = core::read_image(out / "spectrogram/all.exr");
  REQUIRE(image.columns == 16);
  const nlohmann::json axes = tests::json_of(out / "run.json")["axes"];
  const std::vector<double>& power = image.layers.at(0).values;
  // The fastest cell well above noise of a frame; frame k is at (k + 1/2) / 20 s.
  const auto fastest_mps = [&](int frame) {
    for (int row = 0; row < image.rows; ++row) {
      const double speed =
          axes["speed_first_mps"].get<double>() + row * axes["speed_step_mps"].get<double>();
      if (speed > -6.0 && power[static_cast<std::size_t>(row * 16 + frame)] >
                              300.0 * 12.0 * axes["noise_cell_W"].get<double>())
        return speed;
    }
    return 0.0;
  };
  // Legs in opposite phase: one is at 1.4 (1 + |cos 2 pi t|) m/s; 2.8 at 1 s, 1.4 at 1.25 s.
  CHECK(fastest_mps(4) == Approx(-2.8).epsilon(0.0).margin(0.4));
  CHECK(fastest_mps(9) == Approx(-1.4).epsilon(0.0).margin(0.5));
  run =
      tests::run_fanbeam("fmcw street-76ghz -q --products spectrogram --spectrogram-of nobody -o " +
                         tests::quoted(folder.path() / "none"));
  CHECK(run.exit_code == 2);
  CHECK(run.output.find("nobody") != std::string::npos);
}

TEST_CASE("waveform shows what a mixer gets and gives", "[waveform]") {
  const tests::TemporaryFolder folder;
  const fs::path out = folder.path() / "mixer";
  auto run = tests::run_fanbeam("waveform --range 60 --speed -10 --mixer " + tests::quoted(out));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  const std::string beat = tests::bytes_of(out / "beat.csv");
  CHECK(std::count(beat.begin(), beat.end(), '\n') == 1 + 800);
  CHECK(
      tests::bytes_of(out / "mixer.csv").starts_with("time_s,transmitted,received,product\n0,1.0"));
  CHECK(fs::exists(out / "mixer.png"));
  run = tests::run_fanbeam("waveform --mixer " + tests::quoted(out));
  CHECK(run.exit_code == 2);
  run = tests::run_fanbeam("waveform pulsed --range 60 --mixer " + tests::quoted(out));
  CHECK(run.exit_code == 3);
}

// Their radar.toml says real = true, and complex files beside it were refused.
TEST_CASE("Real samples are written as such and read again", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path made = folder.path() / "real";
  const auto run = tests::run_fanbeam(
      "fmcw street-76ghz -q --real --frames 0:3 --products beat -o " + tests::quoted(made));
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  CHECK(core::read_npy_header(made / "beat/00000.npy").type == "<f8");
  const auto followed = track(made, folder.path() / "tracks");
  INFO(followed.output);
  CHECK(followed.exit_code == 0);
}
