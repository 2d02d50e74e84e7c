#include "datasets/run_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.h"

namespace fanbeam::datasets {
namespace {

[[noreturn]] void refuse_lock(const std::filesystem::path& file, int reason, const char* expected) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "lock",
                          std::strerror(reason), expected);
}

// False where another process has it. A file system without locks must not look like that: every
// run would be somebody else's, and none made. Closes the descriptor when it throws.
bool take_lock(int descriptor, const std::filesystem::path& file) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    if (reason == EWOULDBLOCK) return false;
    if (reason == EINTR) continue;
    ::close(descriptor);
    refuse_lock(file, reason, "a file system with locks (flock): some shared ones lack them");
  }
  return true;
}

}  // namespace

RunLock::RunLock(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) refuse_lock(file_, errno, "a folder that can be written to");
  held_ = take_lock(descriptor_, file_);
  // Another one may have removed the file between the two.
  struct stat mine {
  }, there{};
  held_ = held_ && ::fstat(descriptor_, &mine) == 0 && ::stat(file_.c_str(), &there) == 0 &&
          mine.st_ino == there.st_ino;
}

RunLock::~RunLock() {
  if (held_) ::unlink(file_.c_str());
  ::close(descriptor_);
}

bool is_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = !take_lock(descriptor, file);
  ::close(descriptor);
  return locked;
}

}  // namespace fanbeam::datasets
