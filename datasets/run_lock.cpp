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

RunLock::RunLock(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    core::throw_input_error(core::ErrorClass::io, core::Place{file_.string()}, "lock",
                            std::strerror(errno), "a folder that can be written to");
  held_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
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
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

}  // namespace fanbeam::datasets
