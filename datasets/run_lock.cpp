#include "datasets/run_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "core/errors.h"

namespace fanbeam::datasets {
namespace {

[[noreturn]] void refuse_lock(const std::filesystem::path& file, int reason, const char* expected) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "lock",
                          std::strerror(reason), expected);
}

// 0 with the lock of a kind (LOCK_EX, LOCK_SH) in hand, EWOULDBLOCK where another has it, else why there is
// none.
int take_lock(int descriptor, int kind) {
  constexpr int kTries = 4;  // of a server that has no room for a lock just now
  constexpr std::chrono::milliseconds kNap(50);
  for (int tries = 1; ::flock(descriptor, kind | LOCK_NB) != 0;) {
    const int reason = errno;
    if (reason == EINTR) continue;
    if (reason != ENOLCK || tries++ == kTries) return reason;
    std::this_thread::sleep_for(kNap);
  }
  return 0;
}

// Another one may have removed the file between opening and locking.
bool is_still(int descriptor, const std::filesystem::path& file) {
  struct stat mine {
  }, there{};
  return ::fstat(descriptor, &mine) == 0 && ::stat(file.c_str(), &there) == 0 &&
         mine.st_ino == there.st_ino;
}

}  // namespace

RunLock::RunLock(std::filesystem::path file) : file_(std::move(file)) {
  // Who only looks (is_locked, remove_unheld) has the lock, or takes the file away, for a moment.
  constexpr int kTries = 3;
  constexpr std::chrono::milliseconds kNap(5);
  for (int tries = 1; !take() && tries < kTries; ++tries) std::this_thread::sleep_for(kNap);
}

bool RunLock::take() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  const bool made = descriptor_ >= 0;
  if (!made) descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse_lock(file_, errno, "a folder that can be written to");
  const int refused = take_lock(descriptor_, LOCK_EX);
  // A file system without locks must not look like a lock that another has: every run would be
  // somebody else's, and none made.
  if (refused != 0 && refused != EWOULDBLOCK) {
    if (made) ::unlink(file_.c_str());
    ::close(descriptor_);
    refuse_lock(file_, refused, "a file system with locks (flock): some shared ones lack them");
  }
  held_ = refused == 0 && is_still(descriptor_, file_);
  return held_;
}

RunLock::~RunLock() {
  if (held_) ::unlink(file_.c_str());
  ::close(descriptor_);
}

bool is_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = take_lock(descriptor, LOCK_SH) == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

void remove_unheld(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return;
  if (take_lock(descriptor, LOCK_EX) == 0 && is_still(descriptor, file)) ::unlink(file.c_str());
  ::close(descriptor);
}

}  // namespace fanbeam::datasets
