// Pictures as bare bytes to a pipe or a file, for ffmpeg and whatever else reads raw video: 8-bit
// grey, top row first, one picture after the other, nothing between them.
//
// A reader that is slower than the frames misses some: a thread of its own writes the newest one.
// In lockstep it holds the channel up instead, and gets all.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "live/hub.h"

namespace fanbeam::live {

class RawFrames {
 public:
  enum class Scope { bscope, cscope };

  // `file` is created, or a named pipe (which waits for its reader); "-" is the standard output.
  // Throws InputError E-IO.
  RawFrames(Scope scope, const std::string& file, bool every_frame);
  ~RawFrames();  // writes no more
  RawFrames(const RawFrames&) = delete;
  RawFrames& operator=(const RawFrames&) = delete;

  void write(const std::shared_ptr<const LiveFrame>& frame);
  // The reader is gone, or the disk is full.
  bool ended() const;

 private:
  void run();
  void put(const LiveFrame& frame);

  Scope scope_;
  bool every_frame_;
  int file_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const LiveFrame> newest_;
  std::uint64_t written_ = 0;  // number of the frame
  bool ended_ = false, leaving_ = false;
  std::thread writer_;  // unless every frame is wanted
};

}  // namespace fanbeam::live
