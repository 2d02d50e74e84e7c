// The lock of a run: held by another process or not there at all are two things.
#include "datasets/run_lock.h"

#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <functional>
#include <string>

#include "core/errors.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using datasets::RunLock;

namespace {

int refusal = 0;     // that every call answers
int interrupts = 0;  // before the next call is heard

std::string told_by(const std::function<void()>& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// In the place of the C library's.
extern "C" int flock(int descriptor, int operation) noexcept {
  if (interrupts > 0 || refusal != 0) {
    errno = interrupts > 0 ? EINTR : refusal;
    if (interrupts > 0) --interrupts;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
}

TEST_CASE("A file system without locks is an error, and no run that another makes", "[run_lock]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("run.lock", "");
  for (const int reason : {ENOSYS, ENOLCK, EOPNOTSUPP}) {
    refusal = reason;
    const std::string told = told_by([&] { RunLock lock(file); });
    const std::string told_again = told_by([&] { datasets::is_locked(file); });
    refusal = 0;
    CHECK(told.find("E-IO lock") != std::string::npos);
    CHECK(told.find("flock") != std::string::npos);
    CHECK(told_again == told);
  }
}

TEST_CASE("A lock is held by one alone, and a signal does not lose it", "[run_lock]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "run.lock";
  CHECK_FALSE(datasets::is_locked(file));
  interrupts = 2;
  const RunLock lock(file);
  CHECK(lock.held());
  CHECK(datasets::is_locked(file));
  CHECK_FALSE(RunLock(file).held());
}
