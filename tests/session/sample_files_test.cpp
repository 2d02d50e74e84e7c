// Which files of a folder are frames of samples or detections, and in what order.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "session/signal/detection_file.h"
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
