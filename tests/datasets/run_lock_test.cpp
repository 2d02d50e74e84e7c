// The lock of a run: held by another process or not there at all are two things.
#include "datasets/run_lock.h"

#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <string>

#include "core/errors.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using datasets::RunLock;

namespace {

int refusal = 0;     // that every call answers
int interrupts = 0;  // before the next call is heard
int full = 0;        // calls that find no room
int looks = 0;       // calls that find somebody who only looks
int asked = 0;       // of the last call

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
  asked = operation;
  int* const next = interrupts > 0 ? &interrupts : full > 0 ? &full : looks > 0 ? &looks : nullptr;
  if (next != nullptr || refusal != 0) {
    errno = next == &interrupts ? EINTR
            : next == &full     ? ENOLCK
            : next == &looks    ? EWOULDBLOCK
                                : refusal;
    if (next != nullptr) --*next;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
}

TEST_CASE("A file system without locks is an error, and no run that another makes", "[run_lock]") {
  const tests::TemporaryFolder folder;
  const auto left = folder.write("left.lock", "");
  const auto fresh = folder.path() / "fresh.lock";
  for (const int reason : {ENOSYS, ENOLCK, EOPNOTSUPP}) {
    refusal = reason;
    const std::string told = told_by([&] { RunLock lock(fresh); });
    const bool locked = datasets::is_locked(left);
    refusal = 0;
    CHECK(told.find("E-IO lock") != std::string::npos);
    CHECK(told.find("flock") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(fresh));
    CHECK_FALSE(locked);
  }
}

TEST_CASE("A server that has no room for a lock is asked again", "[run_lock]") {
  const tests::TemporaryFolder folder;
  full = 2;
  CHECK(RunLock(folder.path() / "run.lock").held());
  CHECK(full == 0);
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

// A status that looked took the lock for a moment, and a worker left the run to nobody.
TEST_CASE("Who looks at a lock neither has it nor hinders who takes it", "[run_lock]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("run.lock", "");
  CHECK_FALSE(datasets::is_locked(file));
  CHECK((asked & LOCK_SH) != 0);
  looks = 2;
  CHECK(RunLock(file).held());
  CHECK(looks == 0);
}

TEST_CASE("A lock that was left is taken away, one that is held is not", "[run_lock]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("run.lock", "");
  {
    const RunLock lock(file);
    datasets::remove_unheld(file);
    CHECK(std::filesystem::exists(file));
    CHECK(lock.held());
  }
  folder.write("run.lock", "");
  datasets::remove_unheld(file);
  CHECK_FALSE(std::filesystem::exists(file));
  datasets::remove_unheld(file);
}
