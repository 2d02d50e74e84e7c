// What is read of several files of detections together.
#include "session/signal/detection_file.h"

#include <catch2/catch.hpp>
#include <string>

#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using tests::TemporaryFolder;

namespace {

// What is wrong with a folder's detections, if something is.
std::string fault_of(const TemporaryFolder& folder) {
  core::ProblemList problems;
  session::read_detections(folder.path(), problems);
  CHECK(problems.all().size() <= 1);
  return problems.all().empty() ? "" : to_string(problems.all().front());
}

// All of one moment.
std::string table_of(int detections) {
  std::string text = "time_s,range_m,radial_speed_mps,azimuth_deg\n";
  for (int i = 0; i < detections; ++i) text += "1,9,0,0\n";
  return text;
}

std::string empty_frames(int first, int count) {
  std::string text = R"({"frames":[)";
  for (int i = 0; i < count; ++i)
    text.append(i == 0 ? "" : ",")
        .append(R"({"detections":[],"time_s":)")
        .append(std::to_string(first + i))
        .append("}");
  return text + "]}";
}

}  // namespace

// They held of each file alone.
TEST_CASE("A frame takes 100 000 detections from all files together", "[detection_file]") {
  const TemporaryFolder folder;
  folder.write("a.csv", table_of(60'000));
  folder.write("b.csv", table_of(40'000));
  CHECK(fault_of(folder).empty());
  folder.write("c.csv", table_of(1));
  folder.write("d.csv", table_of(1));
  const std::string fault = fault_of(folder);
  CHECK(fault.find("c.csv") != std::string::npos);
  CHECK(fault.find("E-LIMIT detections in a frame = more than 100000") != std::string::npos);
}

TEST_CASE("A million frames are taken from all files together", "[detection_file]") {
  const TemporaryFolder folder;
  folder.write("a.json", empty_frames(0, 600'000));
  folder.write("b.json", empty_frames(600'000, 400'001));
  core::ProblemList problems;
  CHECK(session::read_detections(folder.path(), problems).size() == 1'000'000);
  REQUIRE(problems.all().size() == 1);
  const std::string fault = to_string(problems.all().front());
  CHECK(fault.find("b.json") != std::string::npos);
  CHECK(fault.find("E-LIMIT frames = more than 1000000") != std::string::npos);
}

// The second one was dropped, and what it said of the radar with it.
TEST_CASE("Frames of one time have the radar's velocity of whichever tells it",
          "[detection_file]") {
  const TemporaryFolder folder;
  const auto frame = [](const std::string& velocity) {
    return R"({"time_s": 1, "detections": [])" + velocity + "}";
  };
  const std::string told = R"(, "radar_velocity_mps": [8, 1])";
  core::ProblemList problems;
  folder.write("a.json", R"({"frames": [)" + frame("") + "," + frame(told) + "]}");
  folder.write("b.json", frame(told));
  const auto frames = session::read_detections(folder.path(), problems);
  problems.throw_if_errors();
  REQUIRE(frames.size() == 1);
  CHECK(frames[0].radar_velocity_mps == session::RadarVelocity_mps{8.0, 1.0});
  folder.write("c.json", frame(R"(, "radar_speed_mps": 9)"));
  const std::string fault = fault_of(folder);
  CHECK(fault.find("c.json: E-RANGE frame 0 radar_velocity_mps = [9, 0]: expected [8, 1]") !=
        std::string::npos);
}
