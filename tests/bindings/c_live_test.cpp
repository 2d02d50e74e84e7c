// The session's own thread: whole frames of the newest pose, while others submit, read, set and stop.
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>
#include <vector>

#include "bindings/c/fanbeam.h"
#include "tests/bindings/c_session.h"

using namespace fanbeam;
using tests::Buffers;
using tests::CSession;
using tests::sized;
using tests::TemporaryFolder;
using tests::told;

namespace {

struct Seen {
  fanbeam_frame frame;
  Buffers buffers;
};

// By a thread of its own: Catch's assertions are for one thread.
std::vector<Seen> frames_read(fanbeam_session* session, const fanbeam_facts& facts,
                              std::size_t count) {
  std::vector<Seen> seen;
  fanbeam_frame frame = sized<fanbeam_frame>();
  Buffers buffers(facts);
  while (seen.size() < count) {
    if (tests::awaited(session, frame, buffers) != FANBEAM_OK) return seen;
    seen.push_back({frame, buffers});
  }
  return seen;
}

fanbeam_pose pose_of(const fanbeam_frame& frame) {
  fanbeam_pose pose = sized<fanbeam_pose>();
  pose.time_s = frame.time_s;
  pose.latitude_rad = frame.latitude_rad;
  pose.longitude_rad = frame.longitude_rad;
  pose.height_m = frame.height_m;
  pose.roll_rad = frame.roll_rad;
  pose.pitch_rad = frame.pitch_rad;
  pose.heading_rad = frame.heading_rad;
  return pose;
}

}  // namespace

TEST_CASE("Poses from two threads become whole frames with rising numbers for two threads",
          "[bindings][threads]") {
  const TemporaryFolder folder;
  fanbeam_setup setup = tests::c_setup();
  setup.realisation = FANBEAM_SAMPLE;  // so that a frame's number is in its bytes
  setup.samples_per_cell = 1.0;
  setup.threads = 2;
  const CSession c = tests::c_opened(folder, tests::kSmallScene, setup);
  const fanbeam_facts facts = tests::facts_of(c);
  std::vector<fanbeam_pose> poses;
  for (std::uint32_t i = 0; i < 8; ++i) poses.push_back(tests::flown(c, 10 * i));

  std::atomic<bool> done{false};
  std::atomic<int> refused{0};
  const auto submit = [&](std::size_t first) {
    for (std::size_t i = first; !done; ++i) {
      if (fanbeam_submit_pose(c.get(), &poses[i % poses.size()]) != FANBEAM_OK) ++refused;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  std::thread one(submit, std::size_t{0}), two(submit, std::size_t{3});
  std::vector<Seen> here, there;
  std::thread reader([&] { there = frames_read(c.get(), facts, 4); });
  here = frames_read(c.get(), facts, 4);
  reader.join();
  done = true;
  one.join();
  two.join();

  CHECK(refused == 0);
  for (const std::vector<Seen>* seen : {&here, &there}) {
    REQUIRE(seen->size() == 4);
    std::uint64_t before = 0;
    for (const Seen& each : *seen) {
      CHECK(each.frame.number > before);
      before = each.frame.number;
      CHECK(each.frame.render_s > 0.0);
      CHECK(each.frame.pose_age_s >= 0.0);
      CHECK(each.frame.age_s >= 0.0);
      // The picture of that pose and number and of nothing else, so never of two frames.
      const Buffers alone = tests::c_rendered(c, pose_of(each.frame), each.frame.number);
      CHECK((each.buffers.bscope == alone.bscope));
      CHECK((each.buffers.cscope == alone.cscope));
    }
  }
}

TEST_CASE("A frame is told once, and a buffer that is not given is not asked for", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_facts facts = tests::facts_of(c);
  fanbeam_frame frame = sized<fanbeam_frame>();
  Buffers buffers(facts);
  const auto latest = [&] {
    return fanbeam_latest_frame(c.get(), &frame, nullptr, 0, buffers.cscope.data(),
                                buffers.cscope.size());
  };
  CHECK(latest() == FANBEAM_NOTHING_NEW);  // before any pose
  const fanbeam_pose pose = tests::flown(c);
  REQUIRE(fanbeam_submit_pose(c.get(), &pose) == FANBEAM_OK);
  REQUIRE(tests::awaited(c.get(), frame, buffers) == FANBEAM_OK);
  CHECK(frame.number == 1);
  CHECK(frame.height_m == pose.height_m);
  CHECK(latest() == FANBEAM_NOTHING_NEW);
  frame.number = 0;
  CHECK(latest() == FANBEAM_OK);

  frame.number = 0;
  const Buffers untouched(facts);
  buffers = untouched;
  CHECK(fanbeam_latest_frame(c.get(), &frame, buffers.bscope.data(), 1, nullptr, 0) ==
        FANBEAM_SHORT_BUFFER);
  frame.size = 8;
  CHECK(fanbeam_latest_frame(c.get(), &frame, nullptr, 0, nullptr, 0) == FANBEAM_BAD_SIZE);
  CHECK((buffers == untouched));
}

TEST_CASE("A pose that nothing can be rendered at is refused, once, and the next one is not",
          "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_facts facts = tests::facts_of(c);
  const fanbeam_pose good = tests::flown(c);
  fanbeam_pose bad = good;
  bad.pitch_rad = std::nan("");
  CHECK(fanbeam_submit_pose(c.get(), &bad) == FANBEAM_BAD_INPUT);  // seen at once
  bad = good;
  bad.latitude_rad = 0.0;  // far from the scene: only its frame tells
  REQUIRE(fanbeam_submit_pose(c.get(), &bad) == FANBEAM_OK);
  const Buffers untouched(facts);
  Buffers buffers = untouched;
  fanbeam_frame frame = sized<fanbeam_frame>();
  frame.height_m = -1.0;
  CHECK(tests::awaited(c.get(), frame, buffers) == FANBEAM_BAD_INPUT);
  CHECK(told("1000 km"));
  CHECK(frame.number == 1);
  CHECK(frame.height_m == -1.0);
  CHECK((buffers == untouched));
  CHECK(fanbeam_latest_frame(c.get(), &frame, nullptr, 0, nullptr, 0) == FANBEAM_NOTHING_NEW);
  REQUIRE(fanbeam_submit_pose(c.get(), &good) == FANBEAM_OK);
  CHECK(tests::awaited(c.get(), frame, buffers) == FANBEAM_OK);
  CHECK(frame.number == 2);
}

TEST_CASE("Sessions close while their threads render", "[bindings][threads]") {
  const TemporaryFolder folder;
  for (int turn = 0; turn < 3; ++turn) {
    const CSession c = tests::c_opened(folder);
    const fanbeam_pose pose = tests::flown(c);
    REQUIRE(fanbeam_submit_pose(c.get(), &pose) == FANBEAM_OK);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * turn));
  }
  SUCCEED("closed");
}
