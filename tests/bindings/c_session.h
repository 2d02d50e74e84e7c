// A small scene opened through fanbeam.h.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bindings/c/fanbeam.h"
#include "core/pose.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

// All zero but for its size.
template <class Struct>
Struct sized() {
  Struct empty{};
  empty.size = sizeof(Struct);
  return empty;
}

struct CloseSession {
  void operator()(fanbeam_session* session) const { fanbeam_close(session); }
};
using CSession = std::unique_ptr<fanbeam_session, CloseSession>;

inline fanbeam_setup c_setup() {
  fanbeam_setup setup = sized<fanbeam_setup>();
  setup.shipped_folder = FANBEAM_SOURCE_DIR;
  setup.samples_per_cell = 2.0;  // slices per column: enough to differ, quick
  setup.seed = 7;
  return setup;
}

inline CSession c_opened(const TemporaryFolder& folder, const std::string& text = kSmallScene,
                         const fanbeam_setup& setup = c_setup()) {
  folder.write("scene.toml", text);
  fanbeam_session* session = nullptr;
  const fanbeam_status status = fanbeam_open(folder.path().c_str(), &setup, &session);
  INFO(fanbeam_last_error());
  REQUIRE(status == FANBEAM_OK);
  REQUIRE(session != nullptr);
  return CSession(session);
}

inline fanbeam_facts facts_of(const CSession& session) {
  fanbeam_facts facts = sized<fanbeam_facts>();
  REQUIRE(fanbeam_get_facts(session.get(), &facts) == FANBEAM_OK);
  return facts;
}

inline fanbeam_pose flown(const CSession& session, std::uint32_t frame = 40) {
  fanbeam_pose pose = sized<fanbeam_pose>();
  REQUIRE(fanbeam_flown_pose(session.get(), frame, &pose) == FANBEAM_OK);
  return pose;
}

inline core::Pose core_pose(const fanbeam_pose& pose) {
  core::Pose result;
  result.time_s = pose.time_s;
  result.position = {pose.latitude_rad, pose.longitude_rad, pose.height_m};
  result.q_NB = core::quaternion_from({pose.roll_rad, pose.pitch_rad, pose.heading_rad});
  result.v_N_mps = glm::dvec3(pose.north_mps, pose.east_mps, pose.down_mps);
  return result;
}

// Buffers of the right sizes, filled with what no picture is likely to hold everywhere.
struct Buffers {
  std::vector<std::uint8_t> bscope, cscope;
  std::vector<double> bscope_W, cscope_W_m3;

  explicit Buffers(const fanbeam_facts& facts)
      : bscope(std::size_t{facts.columns} * facts.bscope_rows, 0xA5),
        cscope(std::size_t{facts.columns} * facts.cscope_rows, 0xA5),
        bscope_W(bscope.size(), -1.0),
        cscope_W_m3(cscope.size(), -1.0) {}
  bool operator==(const Buffers&) const = default;

  fanbeam_output output() {
    fanbeam_output output = sized<fanbeam_output>();
    output.bscope = bscope.data();
    output.bscope_count = bscope.size();
    output.cscope = cscope.data();
    output.cscope_count = cscope.size();
    output.bscope_W = bscope_W.data();
    output.bscope_W_count = bscope_W.size();
    output.cscope_W_m3 = cscope_W_m3.data();
    output.cscope_W_m3_count = cscope_W_m3.size();
    return output;
  }
};

inline Buffers c_rendered(const CSession& session, const fanbeam_pose& pose,
                          std::uint64_t frame_index = 0) {
  Buffers buffers(facts_of(session));
  fanbeam_output output = buffers.output();
  const fanbeam_status status = fanbeam_render(session.get(), &pose, frame_index, &output);
  INFO(fanbeam_last_error());
  REQUIRE(status == FANBEAM_OK);
  return buffers;
}

inline bool told(const std::string& words) {
  return std::string(fanbeam_last_error()).find(words) != std::string::npos;
}

inline std::size_t problems_told() {
  const std::string text = fanbeam_last_error();
  return text.empty() ? 0
                      : static_cast<std::size_t>(1 + std::count(text.begin(), text.end(), '\n'));
}

// The newest frame once there is another one than `frame` has; a minute at most.
inline fanbeam_status awaited(fanbeam_session* session, fanbeam_frame& frame, Buffers& buffers) {
  for (int turn = 0; turn < 60000; ++turn) {
    const fanbeam_status status =
        fanbeam_latest_frame(session, &frame, buffers.bscope.data(), buffers.bscope.size(),
                             buffers.cscope.data(), buffers.cscope.size());
    if (status != FANBEAM_NOTHING_NEW) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return FANBEAM_NOTHING_NEW;
}

}  // namespace fanbeam::tests
