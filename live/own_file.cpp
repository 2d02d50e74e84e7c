#include "live/own_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.h"

namespace fanbeam::live {

OwnFile::OwnFile(std::filesystem::path file, std::string field, std::string expected)
    : file_(std::move(file)), field_(std::move(field)), expected_(std::move(expected)) {
  // Opening a named pipe waits for whoever reads from it, and swallows signals meanwhile.
  constexpr int kFlags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK;
  descriptor_ = ::open(file_.c_str(), kFlags | O_EXCL, 0666);
  made_ = descriptor_ >= 0;
  if (!made_) descriptor_ = ::open(file_.c_str(), kFlags, 0666);
  const int reason = errno;
  struct stat facts {};
  const bool opened = descriptor_ >= 0;
  const bool known = (opened ? ::fstat(descriptor_, &facts) : ::stat(file_.c_str(), &facts)) == 0;
  if (known && (S_ISFIFO(facts.st_mode) || S_ISSOCK(facts.st_mode))) {
    if (opened) ::close(descriptor_);
    refuse("not a file");
  }
  if (!opened) refuse(reason);
  ::fcntl(descriptor_, F_SETFL, 0);
  regular_ = known && S_ISREG(facts.st_mode);
  // A file system without locks refuses otherwise, and is written to all the same.
  if (regular_ && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    refuse("being written already");
  }
}

OwnFile::~OwnFile() {
  if (made_ && !begun_) ::unlink(file_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OwnFile::begin() {
  if (std::exchange(begun_, true)) return;
  if (regular_ && ::ftruncate(descriptor_, 0) != 0) refuse(errno);
}

void OwnFile::write(std::string_view bytes) {
  const off_t from = ::lseek(descriptor_, 0, SEEK_CUR);
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      if (regular_ && ::ftruncate(descriptor_, from) == 0) ::lseek(descriptor_, from, SEEK_SET);
      refuse(reason);
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

// Some file systems refuse only here.
void OwnFile::close() {
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) refuse(errno);
}

void OwnFile::refuse(int reason) const { refuse(std::string(std::strerror(reason))); }

void OwnFile::refuse(const std::string& value) const {
  core::throw_input_error(core::ErrorClass::io, core::Place{file_.string()}, field_, value,
                          expected_);
}

}  // namespace fanbeam::live
