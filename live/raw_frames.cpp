#include "live/raw_frames.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>

#include "core/errors.h"
#include "core/stop.h"

namespace fanbeam::live {

RawFrames::RawFrames(Scope scope, const std::string& file, bool every_frame)
    : scope_(scope), every_frame_(every_frame) {
  file_ = file == "-" ? ::dup(STDOUT_FILENO)
                      : ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0)
    core::throw_input_error(core::ErrorClass::io, core::Place{file}, "--to", std::strerror(errno),
                            "a file or pipe that can be written");
  if (!every_frame_) writer_ = std::thread([this] { run(); });
}

RawFrames::~RawFrames() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    leaving_ = true;
  }
  changed_.notify_all();
  if (writer_.joinable()) writer_.join();
  ::close(file_);
}

bool RawFrames::ended() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ended_;
}

void RawFrames::write(const std::shared_ptr<const LiveFrame>& frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!frame || frame->number == written_ || ended_) return;
    newest_ = frame;
    if (every_frame_) written_ = frame->number;
  }
  if (every_frame_)
    put(*frame);
  else
    changed_.notify_all();
}

void RawFrames::run() {
  for (;;) {
    std::shared_ptr<const LiveFrame> frame;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [&] { return leaving_ || (newest_ && newest_->number != written_); });
      if (leaving_) return;
      frame = newest_;
      written_ = frame->number;
    }
    put(*frame);
  }
}

// Whole, or until the reader is gone; a reader that stands still holds nobody's end up.
void RawFrames::put(const LiveFrame& frame) {
  constexpr int kNap_ms = 100;
  const core::Picture8& picture = scope_ == Scope::bscope ? frame.bscope : frame.cscope;
  std::size_t done = 0;
  while (done < picture.pixels.size()) {
    pollfd ready{file_, POLLOUT, 0};
    ::poll(&ready, 1, kNap_ms);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (leaving_) return;
    }
    if (core::StopScope::current().reason() != 0) return;  // in lockstep the channel's own thread
    if ((ready.revents & (POLLOUT | POLLERR | POLLHUP)) == 0) continue;
    // No more than a pipe takes at once: it would wait for its reader.
    const std::size_t part = std::min<std::size_t>(picture.pixels.size() - done, PIPE_BUF);
    const ssize_t count = ::write(file_, picture.pixels.data() + done, part);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended_ = true;
      return;
    }
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace fanbeam::live
