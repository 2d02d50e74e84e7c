// Pictures as bare bytes to a pipe or a file, for ffmpeg and whatever else reads raw video: 8-bit
// grey, top row first, one picture after the other, nothing between them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "live/frame_taker.h"
#include "live/own_file.h"

namespace fanbeam::live {

class RawFrames {
 public:
  enum class Scope { bscope, cscope };

  // `file` is created, or a named pipe, which gets frames from when it has a reader; "-" is the standard
  // output. Throws InputError E-IO, also where another process or sink writes the file.
  RawFrames(Scope scope, const std::string& file, bool every_frame);
  ~RawFrames();  // as close(), but tells nobody
  RawFrames(const RawFrames&) = delete;
  RawFrames& operator=(const RawFrames&) = delete;

  // Frames will come: what was in the file is gone. The first frame does so too.
  void begin() {
    if (own_) own_->begin();
  }
  void write(const std::shared_ptr<const LiveFrame>& frame) {
    begin();
    if (taker_) taker_->write(frame);
  }
  // The reader is gone, or the disk is full.
  bool ended() const { return !taker_ || taker_->ended(); }
  // Writes no more. Throws InputError E-IO where the system refused to write; that the reader left is a
  // good end.
  void close();

 private:
  bool put(const LiveFrame& frame, const FrameTaker& taker);
  bool has_reader();
  bool refused();
  [[noreturn]] void refuse(int reason) const;

  Scope scope_;
  std::string name_;
  std::string pipe_{};  // that waits for its reader
  bool every_frame_;
  std::optional<OwnFile> own_;  // neither a pipe nor the standard output
  int file_ = -1;
  int fault_ = 0;  // errno of what was refused, of the taker's thread
  std::optional<FrameTaker> taker_;
};

}  // namespace fanbeam::live
