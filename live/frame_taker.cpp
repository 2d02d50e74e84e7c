#include "live/frame_taker.h"

#include <utility>

#include "core/stop.h"

namespace fanbeam::live {
namespace {

// The thread that calls was asked to stop, and not because time is up.
bool is_hurried() {
  const int reason = core::StopScope::current().reason();
  return reason != 0 && reason != kTimeIsUp;
}

}  // namespace

FrameTaker::FrameTaker(Put put, bool every_frame)
    : put_(std::move(put)), every_frame_(every_frame) {
  if (!every_frame_) thread_ = std::thread([this] { run(); });
}

FrameTaker::~FrameTaker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    leaving_ = is_hurried();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

bool FrameTaker::ended() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ended_;
}

// In lockstep the sink is called by the channel's own thread.
bool FrameTaker::ending() const {
  if (core::StopScope::current().reason() != 0) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return ending_;
}

bool FrameTaker::leaving() const {
  if (is_hurried()) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return leaving_;
}

void FrameTaker::write(const std::shared_ptr<const LiveFrame>& frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!frame || frame->stale || frame == taken_ || ended_) return;
    newest_ = frame;
    if (every_frame_) taken_ = frame;
  }
  if (every_frame_)
    put(*frame);
  else
    changed_.notify_all();
}

void FrameTaker::run() {
  for (;;) {
    std::shared_ptr<const LiveFrame> frame;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [&] { return ending_ || newest_ != taken_; });
      if (ending_) return;
      frame = taken_ = newest_;
    }
    put(*frame);
  }
}

void FrameTaker::put(const LiveFrame& frame) {
  if (put_(frame, *this)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ended_ = true;
}

}  // namespace fanbeam::live
