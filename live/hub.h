// Where frames and what is said of them meet: the channel puts them in, whoever shows them takes the
// newest. Whoever asks about one that a page still shows gets what it was made of, for a minute and while
// no more than 32 changes of conditions came after it. Thread-safe.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/pose.h"
#include "session/session.h"

namespace fanbeam::live {

// Of the expected picture, grey levels RMS.
struct PictureErrors {
  double bscope_grey = 0.0, cscope_grey = 0.0;
};

struct LiveFrame {
  std::uint64_t number = 0;                      // from 1 up; one that is stale has its own
  core::Pose pose;                               // of the frame's middle
  session::Session::Moment under{};              // conditions and sampling
  std::shared_ptr<const scenes::Scene> scene{};  // of `under`
  core::Picture8 bscope, cscope;
  double low_dB = 0.0, high_dB = 0.0;  // of grey 0 and 255
  double cscope_top_rad = 0.0;         // upper edge
  // Of the B-scope's cells, near row first; where a sink wants it.
  std::vector<double> received_W{};
  double samples = 0.0;  // as fanbeam render --rays-per-cell takes it
  double frame_ms = 0.0;
  double pose_age_ms = 0.0;     // between the pose's arrival and the frame's beginning
  double began_s = 0.0;         // then, by CLOCK_MONOTONIC; of a stale one: the picture's
  bool outside_volume = false;  // made by a plan of its own (session.h)
  bool stale = false;           // shown once more, as no pose of a second could be rendered
  std::optional<PictureErrors> errors{};  // of its sampling, as far as they were known
};

// What a frame was made of, its sampling apart.
struct FrameOrigin {
  std::uint64_t number = 0;
  core::Pose pose;
  std::shared_ptr<const scenes::Scene> scene;
};

struct Status {
  std::string start;  // of the hub, another of each: frames of another are numbered anew
  std::string scene, source, caster;
  std::uint64_t frames = 0;  // rendered: one that is shown once more has a number, and is none
  std::uint64_t late = 0;    // ticks left out, as frames took longer than a period
  // Took more processor time than a period has on all its threads: late on any machine, however quiet.
  std::uint64_t late_by_processor = 0;
  std::uint64_t refused = 0;                // poses that nothing can be rendered at
  std::string refusal;                      // the last one's words
  std::string weather_refusal;              // of the simulator's weather, while it is refused
  std::string host_time;                    // that a CIGI host says it is there; empty: none told
  double wanted_Hz = 0.0, rate_Hz = 0.0;    // rate: of the last two seconds
  double frame_ms = 0.0, slowest_ms = 0.0;  // the last one, the slowest of two seconds
  double processor_ms = 0.0;                // of the last one, all threads
  double pose_age_ms = 0.0, samples = 0.0;
  std::optional<PictureErrors> errors;  // of this sampling, once they are known (quality.h)
  bool waiting = true;                  // no pose yet
  bool stale = false;  // no pose of the last second could be rendered: the picture stands
  // Of all sources that listen: packets, and those of no use by reason. Of the one whose poses count:
  // the median of its height above ground less ours over the last five seconds (live/feed.h).
  std::uint64_t packets = 0;
  std::vector<std::pair<std::string, std::uint64_t>> bad_packets;
  std::uint64_t stray_poses = 0;  // of packets that were good by themselves (predictor.h)
  // Parts of good packets that mean nothing here, by name (live/cigi_ig.h), or cannot be.
  std::vector<std::pair<std::string, std::uint64_t>> unused_packets;
  std::optional<double> height_offset_m;
};

// More than two terrains of one place differ by, as a rule.
inline bool is_lasting_offset(const Status& status) {
  constexpr double kMost_m = 3.0;
  return status.height_offset_m && std::abs(*status.height_offset_m) > kMost_m;
}

class Hub {
 public:
  Hub() = default;
  // `kept_s`: how long it is known what a frame was made of.
  explicit Hub(double kept_s) : kept_s_(kept_s) {}

  void publish(std::shared_ptr<const LiveFrame> frame) {
    std::function<void()> call;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      remember({frame->number, frame->pose, frame->scene});
      newest_ = std::move(frame);
      call = on_frame_;
    }
    if (call) call();
  }
  // Nothing before the first frame.
  std::shared_ptr<const LiveFrame> newest() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }
  // Nothing where it is not kept.
  std::optional<FrameOrigin> origin(std::uint64_t number) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [made, origin] : origins_)
      if (origin.number == number) return origin;
    return std::nullopt;
  }

  void tell(const Status& status) {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_ = status;
  }
  Status status() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Status status = status_;
    status.start = start_;
    return status;
  }

  // Called after each frame by the thread that made it: must return at once and not throw.
  void on_frame(std::function<void()> call) {
    const std::lock_guard<std::mutex> lock(mutex_);
    on_frame_ = std::move(call);
  }

 private:
  using Steady = std::chrono::steady_clock;

  // Conditions take megabytes: where targets move they are others in every frame.
  static constexpr std::size_t kMostChanges = 32, kMostOrigins = 65536;

  void remember(FrameOrigin origin) {
    const Steady::time_point now = Steady::now();
    if (!origins_.empty() && origins_.back().second.scene != origin.scene) ++changes_;
    origins_.emplace_back(now, std::move(origin));
    const auto old = [&](Steady::time_point made) {
      return std::chrono::duration<double>(now - made).count() > kept_s_;
    };
    while (old(origins_[0].first) || origins_.size() > kMostOrigins || changes_ > kMostChanges) {
      if (origins_[0].second.scene != origins_[1].second.scene) --changes_;
      origins_.pop_front();
    }
  }

  const std::string start_ =
      std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  double kept_s_ = 64.0;
  mutable std::mutex mutex_;
  std::shared_ptr<const LiveFrame> newest_;
  std::deque<std::pair<Steady::time_point, FrameOrigin>> origins_;  // by when they were published
  std::size_t changes_ = 0;  // of conditions from one of them to the next
  Status status_;
  std::function<void()> on_frame_;
};

}  // namespace fanbeam::live
