// Renders the newest pose on a thread of its own, while whoever hands poses in and takes frames out
// goes on: poses come by one atomic exchange, frames leave through a NewestRing.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "bindings/c/convert.h"
#include "bindings/c/fanbeam.h"
#include "bindings/c/newest_ring.h"
#include "core/stop.h"
#include "session/session.h"

namespace fanbeam::bindings {

using Clock = std::chrono::steady_clock;

// What became of a pose: pictures, or a refusal.
struct Outcome {
  std::uint64_t number = 0;  // from 1 up; the frame index too
  fanbeam_status status = FANBEAM_OK;
  std::array<char, 1024> refusal{};  // ends with a zero
  fanbeam_pose pose{};
  std::uint32_t events = 0;
  double pose_age_s = 0.0;  // at the frame's beginning
  double render_s = 0.0;
  Clock::time_point ended{};
  std::vector<std::uint8_t> bscope, cscope;  // as before where there is a refusal
};

class BackgroundRenderer {
 public:
  // Both must outlive it.
  BackgroundRenderer(const session::Session& session, core::StopSource& stop);
  // Asks `stop` to stop, and waits until the frame under way has done so.
  ~BackgroundRenderer();
  BackgroundRenderer(const BackgroundRenderer&) = delete;
  BackgroundRenderer& operator=(const BackgroundRenderer&) = delete;

  // From any thread, without a lock once the thread runs. The first call starts it, which may throw
  // std::system_error: then the next one tries again. The pose must have been checked.
  void submit(const fanbeam_pose& pose);

  NewestRing<Outcome>& outcomes() { return outcomes_; }

 private:
  struct Letter {
    fanbeam_pose pose;
    Clock::time_point arrived;
  };
  void ring();
  void run() noexcept;
  void render(const Letter& letter) noexcept;
  // A free slot; nullptr when it is to stop before readers leave one.
  Outcome* claimed() noexcept;

  const session::Session& session_;
  core::StopSource& stop_;
  NewestRing<Outcome> outcomes_;
  std::atomic<Letter*> waiting_{nullptr};  // owned by whoever takes it out
  std::atomic<std::uint32_t> bell_{0};     // counts what the thread has to look at
  std::once_flag started_;
  std::uint64_t number_ = 0;  // the thread's own
  std::thread thread_;
};

}  // namespace fanbeam::bindings
