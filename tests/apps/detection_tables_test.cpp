// fanbeam track of folders of tables of detections, as fanbeam fmcw writes one for every frame.
#include <fmt/format.h>

#include <complex>

#include "core/npy.h"
#include "session/signal/sources/track_input.h"
#include "tests/apps/program.h"

using namespace fanbeam;
using tests::track;
namespace fs = std::filesystem;

namespace {

constexpr int kFlightFrames = 10, kEmptyFrame = 4;

double time_of(int frame) { return (frame + 0.5) / 20.0; }
std::string name_of(int frame) { return fmt::format("{:05}", frame); }

// A post ahead of a radar that drives at 20 m/s.
std::string table_of(int frame) {
  std::string text =
      "frame,time_s,detection,range_m,radial_speed_mps,azimuth_deg,elevation_deg,power_W,snr_dB,"
      "forward_m,right_m,cluster\n";
  if (frame == kEmptyFrame) return text;
  const double range_m = 100.0 - 20.0 * time_of(frame);
  return text + fmt::format("{},{:.6f},0,{:.3f},-20.000,0.000,0.000,1e-12,30.00,{:.3f},0.000,-1\n",
                            frame, time_of(frame), range_m, range_m);
}

nlohmann::json record_of(int frames) {
  nlohmann::json list = nlohmann::json::array();
  for (int i = 0; i < frames; ++i)
    list.push_back({{"index", i},
                    {"time_s", time_of(i)},
                    {"radar_speed_mps", 20.0},
                    {"radar_velocity_mps", {20.0, 0.0}},
                    {"files", nlohmann::json::array({"detections/" + name_of(i) + ".csv"})}});
  return {{"frames", list}};
}

// What fanbeam fmcw leaves, without JSON of the detections.
fs::path flight_in(const tests::TemporaryFolder& folder) {
  fs::create_directories(folder.path() / "flight/detections");
  for (int i = 0; i < kFlightFrames; ++i)
    folder.write("flight/detections/" + name_of(i) + ".csv", table_of(i));
  folder.write("flight/run.json", record_of(kFlightFrames).dump());
  return folder.path() / "flight";
}

struct TrackedFlight {
  std::string output;
  nlohmann::json record;
};

TrackedFlight track_flight(const fs::path& input, const fs::path& out,
                           const std::string& words = "") {
  const auto run =
      tests::run_fanbeam("track " + tests::quoted(input) + " -o " + tests::quoted(out) + words);
  INFO(run.output);
  REQUIRE(run.exit_code == 0);
  return {run.output, tests::json_of(out / "run.json")};
}

}  // namespace

TEST_CASE("A folder of tables has the radar's velocity and times of empty ones from fmcw's record",
          "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path flight = flight_in(folder), out = folder.path() / "out";
  // The folder of the run, and that of its detections.
  for (const fs::path& input : {flight, flight / "detections"}) {
    const TrackedFlight told = track_flight(input, out);
    CHECK(told.output.find("W-") == std::string::npos);
    CHECK(told.record["kind"] == "detections");
    CHECK(told.record["frames"] == kFlightFrames);
    CHECK(told.record["radar_velocity_mps"] == nlohmann::json({20.0, 0.0}));
    CHECK(told.record["confirmed_tracks"] == 1);
    CHECK(told.record["moving_tracks"] == 0);
  }
  CHECK(track_flight(flight, out, " --radar-speed 3").record["radar_speed_mps"] == 3.0);
  // A record that does not know all of them tells of none.
  folder.write("flight/run.json", record_of(kFlightFrames - 1).dump());
  const TrackedFlight unknown = track_flight(flight, out);
  CHECK(unknown.output.find("W-TIMES") != std::string::npos);
  CHECK(unknown.output.find("--radar-speed") != std::string::npos);
  CHECK(unknown.record["radar_speed_mps"] == 0.0);
  fs::remove(flight / "run.json");
  const TrackedFlight alone = track_flight(flight, out);
  CHECK(alone.output.find("W-") == std::string::npos);
  CHECK(alone.record["radar_speed_mps"] == 0.0);
  CHECK(alone.record["frames"] == kFlightFrames - 1);
  CHECK(alone.record["moving_tracks"] == 1);
}

TEST_CASE("All that is wrong in a folder of tables is told, and what was tracked before stays",
          "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path flight = flight_in(folder), out = folder.path() / "out";
  REQUIRE(track(flight, out).exit_code == 0);
  const auto before = tests::contents(out);
  folder.write("flight/detections/00001.csv", "time_s,range_m\n");
  folder.write("flight/detections/00002.csv", table_of(2) + "2,0.125,1,-3,0,0,0,0,0,0,0,-1\n");
  folder.write("flight/detections/00003.csv", table_of(0));
  const auto run = track(flight, out);
  INFO(run.output);
  CHECK(run.exit_code == 3);
  for (const char* told :
       {"00001.csv:1: E-REF radial_speed_mps", "00002.csv:3: E-RANGE range_m = -3",
        "00003.csv: E-TIME time_s = 0.025: expected 0.175, as the run.json"})
    CHECK(run.output.find(told) != std::string::npos);
  CHECK(tests::contents(out) == before);
  // Without a record the order of names is that of time.
  for (const int frame : {1, 2, 3})
    folder.write("flight/detections/" + name_of(frame) + ".csv", table_of(3 - frame));
  fs::remove(flight / "run.json");
  const auto back = track(flight, out);
  INFO(back.output);
  CHECK(back.exit_code == 3);
  for (const char* name : {"00002.csv", "00003.csv"})
    CHECK(back.output.find(std::string(name) + ": E-TIME frame 0 time_s") != std::string::npos);
}

// Those without were left out of the flight without a word.
TEST_CASE("Tables beside JSON of their names are the same frames, and those without are refused",
          "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path flight = flight_in(folder), out = folder.path() / "out";
  for (int i = 0; i < kFlightFrames; ++i)
    folder.write(
        "flight/detections/" + name_of(i) + ".json",
        fmt::format(R"({{"time_s": {}, "radar_speed_mps": 7, "detections": []}})", time_of(i)));
  const TrackedFlight both = track_flight(flight, out);
  CHECK(both.record["frames"] == kFlightFrames);
  CHECK(both.record["detections"] == 0);
  CHECK(both.record["radar_speed_mps"] == 7.0);
  fs::remove_all(out);
  for (const char* name : {"00003.json", "00008.json"}) fs::remove(flight / "detections" / name);
  folder.write("flight/detections/00005.json", R"({"time_s": 0.275})");
  const auto run = track(flight, out);
  INFO(run.output);
  CHECK(run.exit_code == 3);
  for (const char* told : {"00003.csv: E-REF", "expected 00003.json beside it", "00008.csv: E-REF",
                           "00005.json: E-REF /detections"})
    CHECK(run.output.find(told) != std::string::npos);
  CHECK(run.output.find("00004.csv") == std::string::npos);
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("A table beside samples is no frame of detections", "[track]") {
  const tests::TemporaryFolder folder;
  const fs::path beat = folder.path() / "beat";
  fs::create_directory(beat);
  core::write_npy(beat / "00000.npy", {1, 1, 1}, std::vector<std::complex<float>>(1));
  folder.write("notes.csv", "what,when\n");
  folder.write("beat/notes.csv", "what,when\n");
  CHECK(session::track_input(folder.path()) == session::TrackInput::samples);
  CHECK(session::track_input(beat) == session::TrackInput::samples);
  fs::remove(beat / "00000.npy");
  CHECK(session::track_input(beat) == session::TrackInput::detections);
}
