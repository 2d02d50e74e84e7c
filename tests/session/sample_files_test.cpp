// Which files of a folder are frames of samples or detections, in what order, and what is wrong with their values.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "core/npy.h"
#include "session/signal/detection_file.h"
#include "session/signal/radar_file.h"
#include "session/signal/sample_file.h"
#include "session/signal/sources/measured_source.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;

namespace {

std::vector<std::string> frames_of(const std::vector<std::string>& names) {
  const tests::TemporaryFolder folder;
  for (const std::string& name : names) folder.write(name, "");
  std::vector<std::string> found;
  for (const auto& file : session::sample_files_in(folder.path()))
    found.push_back(file.filename().string());
  return found;
}

constexpr const char* kRecordingRadar = R"([waveform]
kind = "chirp-sequence"
real = true
frequency_GHz = 76
bandwidth_MHz = 250
sample_rate_MHz = 4
chirps = 16
[array]
transmitters = 1
receivers = 2
[receiver]
noise_figure_dB = 10
)";

// What is wrong with these files of real samples of that radar, a frame each; empty: nothing.
std::string problems_of(const std::vector<std::filesystem::path>& files,
                        const std::string& samples) {
  core::ProblemList problems;
  session::FmcwSettings settings;
  session::read_radar_text(kRecordingRadar + samples, "radar.toml", settings, problems);
  problems.throw_if_errors();
  try {
    const session::SampleFiles read(files, session::fmcw_radar(settings), settings.layout);
    return {};
  } catch (const core::InputError& error) {
    return error.what();
  }
}

std::filesystem::path recorded(const tests::TemporaryFolder& folder, const std::string& name,
                               double amplitude, std::size_t channels = 2) {
  std::vector<double> values;
  for (std::size_t i = 0; i < channels * 16 * 80; ++i)
    values.push_back(amplitude * std::cos(0.5 * static_cast<double>(i)));
  core::write_npy(folder.path() / name, {channels, 16, 80}, values);
  return folder.path() / name;
}

}  // namespace

TEST_CASE("Files of samples come in the order of their numbers, with zeros in front or without",
          "[track]") {
  const std::vector<std::string> order = {"frame_1.npy",  "frame_2.npy",  "frame_010.npy",
                                          "frame_10.npy", "frame_11.npy", "frame_100.npy"};
  CHECK(frames_of({order[5], order[3], order[0], order[4], order[2], order[1], "notes.txt"}) ==
        order);
  CHECK(frames_of({"b2-1.npy", "a10.npy", "b2-0.npy", "a9.npy", "99999999999999999999999.npy"}) ==
        std::vector<std::string>{"99999999999999999999999.npy", "a9.npy", "a10.npy", "b2-0.npy",
                                 "b2-1.npy"});
  const std::vector<std::string> times = {"0.05.npy", "0.1.npy", "0.15.npy", "0.2.npy", "10.1.npy"};
  CHECK(frames_of({times[3], times[0], times[4], times[2], times[1]}) == times);
  const std::vector<std::string> finer = {"0.1.npy", "0.105.npy", "0.11.npy", "0.125.npy",
                                          "0.15.npy"};
  CHECK(frames_of({finer[4], finer[3], finer[2], finer[1], finer[0]}) == finer);
}

// As text 100000 comes before 99999, and time went back there.
TEST_CASE("Files of detections come in the order of their numbers, like those of samples",
          "[track]") {
  const tests::TemporaryFolder folder;
  const auto one = [&](const std::string& name, const std::string& time_s) {
    folder.write(name + ".json", "{\"time_s\": " + time_s + ", \"detections\": []}");
    folder.write(name + ".csv", "");
  };
  one("99999", "1.0");
  one("100000", "2.0");
  core::ProblemList problems;
  const auto frames = session::read_detections(folder.path(), problems);
  problems.throw_if_errors();
  REQUIRE(frames.size() == 2);
  CHECK(frames[1].time_s == 2.0);
}

TEST_CASE("Only the later stages of a frame that is there are left out", "[track]") {
  CHECK(frames_of({"00000.npy", "00000-stage1.npy", "front-stage.npy", "on-stage2.npy",
                   "two-stage-3.npy"}) == std::vector<std::string>{"00000.npy", "front-stage.npy",
                                                                   "on-stage2.npy",
                                                                   "two-stage-3.npy"});
}

// As floats they were zeros, or numbers of a few bits, and nothing was found or at other azimuths.
TEST_CASE("Samples too small for floats are refused, as they are with their scale", "[track]") {
  const tests::TemporaryFolder folder;
  using Catch::Contains;
  CHECK_THAT(problems_of({recorded(folder, "a.npy", 1e-50)}, ""),
             Contains("a.npy: E-RANGE largest value = 1e-50: expected at least 1e-30, or zeros"));
  CHECK_THAT(problems_of({recorded(folder, "b.npy", 1e-14)}, "[samples]\nscale_sqrtW = 1e-30\n"),
             Contains("b.npy: E-RANGE largest value = 1e-14: expected at least 1, or zeros"));
  CHECK_THAT(problems_of({recorded(folder, "c.npy", 1e-35)}, "[samples]\nscale_sqrtW = 1e9\n"),
             Contains("expected at least 1e-30"));
  CHECK(
      problems_of({recorded(folder, "d.npy", 2e-30), recorded(folder, "e.npy", 0.0)}, "").empty());
  CHECK(problems_of({recorded(folder, "f.npy", 2.0)}, "[samples]\nscale_sqrtW = 1e-30\n").empty());
}

TEST_CASE("Values of samples are looked at where the header of another file is wrong", "[track]") {
  const tests::TemporaryFolder folder;
  const std::string told =
      problems_of({recorded(folder, "a.npy", 1.0, 3), recorded(folder, "b.npy", 1e-50)}, "");
  CHECK_THAT(told, Catch::Contains("a.npy: E-RANGE shape"));
  CHECK_THAT(told, Catch::Contains("b.npy: E-RANGE largest value"));
}

TEST_CASE("Calibration of another number of channels is told at the radar file", "[track]") {
  const tests::TemporaryFolder folder;
  const auto radar = folder.write(
      "radar.toml", std::string(kRecordingRadar) + "[samples]\nchannel_gain_dB = [0, 1, 2]\n");
  const auto file = recorded(folder, "a.npy", 1.0);
  CHECK_THROWS_WITH(session::sample_source(file, {file}, radar, {}),
                    Catch::Contains("radar.toml: E-RANGE samples.channel_gain_dB = 3 numbers"));
}
