// A disk that is full from some byte of a file on, while it lives.
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstdint>

namespace fanbeam::tests {

// Of all files of this process: what a test says waits until it is gone.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uint64_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);  // what fits nevertheless, the test sees
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);  // a failed write instead
  rlimit before_{};
};

}  // namespace fanbeam::tests
