// The right to make a run: a lock (flock) that goes with its process, on one machine and on several that
// share the folder.
#pragma once

#include <filesystem>

namespace fanbeam::datasets {

class RunLock {
 public:
  // Looks a few times, a hundredth of a second in all, so that nobody who asks for the state of a run (below)
  // passes for one that makes it. Throws InputError E-IO for a folder that cannot be written to, or whose
  // file system has no locks; then it leaves no file.
  explicit RunLock(std::filesystem::path file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  bool held() const { return held_; }

 private:
  bool take();

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool held_ = false;
};

// Somebody holds it; nobody can where the file system has no locks.
bool is_locked(const std::filesystem::path& file);

// Takes the file away that one who was killed left; one that is held stays.
void remove_unheld(const std::filesystem::path& file);

}  // namespace fanbeam::datasets
