// Hands frames to a sink that may take longer than they come: on a thread of its own the newest one, the
// others are missed. Where every frame is wanted (lockstep) the caller's thread waits for the sink
// instead. Thread-safe.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "live/hub.h"

namespace fanbeam::live {

// Why a flight is stopped when its time is up: what a sink is about may be finished.
inline constexpr int kTimeIsUp = -1;

class FrameTaker {
 public:
  // It asks ending() before it begins and leaving() now and then, and gives false when the sink takes no more.
  using Put = std::function<bool(const LiveFrame&, const FrameTaker&)>;
  FrameTaker(Put put, bool every_frame);
  // The sink is called no more. What it is about it may finish, unless the thread that ends it was asked to stop.
  ~FrameTaker();
  FrameTaker(const FrameTaker&) = delete;
  FrameTaker& operator=(const FrameTaker&) = delete;

  // A frame that was given before is left out, also where it is shown once more as a stale one. Numbers tell
  // nothing here: those of another scene may be the same.
  void write(const std::shared_ptr<const LiveFrame>& frame);
  // The sink gave false.
  bool ended() const;
  // Of the sink's thread: nothing new is to begin.
  bool ending() const;
  // Of the sink's thread: nobody waits for what it is about. Not where time is up.
  bool leaving() const;

 private:
  void run();
  void put(const LiveFrame& frame);

  Put put_;
  bool every_frame_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const LiveFrame> newest_, taken_;
  bool ended_ = false, ending_ = false, leaving_ = false;
  std::thread thread_;  // unless every frame is wanted
};

}  // namespace fanbeam::live
