#include "live/raw_frames.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstring>
#include <thread>
#include <utility>

#include "core/errors.h"

namespace fanbeam::live {
namespace {

constexpr const char* kRawOption = "--to";
constexpr const char* kRawExpected =
    "a file or pipe that can be written, and that nobody else writes";

}  // namespace

RawFrames::RawFrames(Scope scope, const std::string& file, bool every_frame)
    : scope_(scope), name_(file), every_frame_(every_frame) {
  struct stat facts {};
  if (file != "-" && ::stat(file.c_str(), &facts) == 0 && S_ISFIFO(facts.st_mode))
    pipe_ = file;
  else if (file == "-")
    file_ = ::dup(STDOUT_FILENO);
  else
    file_ = own_.emplace(file, kRawOption, kRawExpected).descriptor();
  if (file_ < 0 && pipe_.empty()) refuse(errno);
  taker_.emplace(
      [this](const LiveFrame& frame, const FrameTaker& taker) { return put(frame, taker); },
      every_frame);
}

RawFrames::~RawFrames() {
  taker_.reset();
  if (file_ >= 0 && !own_) ::close(file_);
}

// Some file systems refuse only here.
void RawFrames::close() {
  taker_.reset();
  const int file = std::exchange(file_, -1);
  if (file >= 0 && !own_ && ::close(file) != 0 && fault_ == 0) fault_ = errno;
  if (fault_ != 0 && fault_ != EPIPE) refuse(fault_);
  if (own_) own_->close();
}

void RawFrames::refuse(int reason) const {
  core::throw_input_error(core::ErrorClass::io, core::Place{name_}, kRawOption,
                          std::strerror(reason), kRawExpected);
}

// Opening a pipe that nobody reads would wait, whoever asks to stop.
bool RawFrames::has_reader() {
  if (file_ >= 0) return true;
  file_ = ::open(pipe_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  if (file_ >= 0) ::fcntl(file_, F_SETFL, 0);
  return file_ >= 0;
}

bool RawFrames::refused() {
  fault_ = errno;
  return false;
}

// Whole, also at the end of the flight, or until the reader is gone; a reader that stands still holds
// nobody's end up: not a signal's at all, and that of --seconds for a while.
bool RawFrames::put(const LiveFrame& frame, const FrameTaker& taker) {
  constexpr int kNap_ms = 100, kNaps = 20;
  const core::Picture8& picture = scope_ == Scope::bscope ? frame.bscope : frame.cscope;
  while (!has_reader()) {
    if (errno != ENXIO) return refused();
    if (!every_frame_ || taker.ending()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(kNap_ms));
  }
  std::size_t done = 0;
  int naps = 0;  // in a row
  while (done < picture.pixels.size()) {
    pollfd ready{file_, POLLOUT, 0};
    ::poll(&ready, 1, kNap_ms);
    if ((ready.revents & (POLLOUT | POLLERR | POLLHUP)) == 0) {
      if (taker.leaving() || (taker.ending() && ++naps >= kNaps)) return true;
      continue;
    }
    naps = 0;
    // No more than a pipe takes at once: it would wait for its reader.
    const std::size_t part = std::min<std::size_t>(picture.pixels.size() - done, PIPE_BUF);
    const ssize_t count = ::write(file_, picture.pixels.data() + done, part);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return refused();
    done += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace fanbeam::live
