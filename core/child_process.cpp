#include "core/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "core/stop.h"

namespace fanbeam::core {

ChildProcess::ChildProcess(const std::vector<std::string>& words, Pipe pipe) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  std::signal(SIGPIPE, SIG_IGN);  // a program that dies shows as a failed write
  const bool sends = pipe == Pipe::to_its_input;
  const int its_end = sends ? ends[0] : ends[1];
  pipe_ = sends ? ends[1] : ends[0];
  fcntl(pipe_, F_SETFL, O_NONBLOCK);  // of our end: what the other one takes slowly holds nobody

  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, its_end, sends ? STDIN_FILENO : STDOUT_FILENO);
  if (!sends) posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  // A group in the background of a terminal, which may write to it all the same.
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTTOU);
  posix_spawnattr_setsigmask(&attributes, &blocked);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  if (posix_spawnp(&process_, arguments.front(), &actions, &attributes, arguments.data(),
                   environ) != 0)
    process_ = 0;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(its_end);
  if (process_ == 0) close_pipe();
}

ChildProcess::~ChildProcess() {
  // First: a program that sees its input end may still write what it has.
  if (process_ > 0) kill(process_, SIGKILL);
  close_pipe();
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

void ChildProcess::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

void ChildProcess::wait_for_pipe(short events) const {
  constexpr int kLookUp_ms = 50;  // whether the user wants to stop
  pollfd descriptor{pipe_, events, 0};
  while (poll(&descriptor, 1, kLookUp_ms) <= 0) core::throw_if_stopped();
}

bool ChildProcess::send(std::string_view bytes) {
  while (!bytes.empty()) {
    wait_for_pipe(POLLOUT);
    const ssize_t count = write(pipe_, bytes.data(), bytes.size());
    if (count < 0 && errno == EAGAIN) continue;
    if (count <= 0) {
      core::throw_if_stopped();  // what the user ended did not fail
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::string ChildProcess::receive() {
  wait_for_pipe(POLLIN);
  std::array<char, 4096> chunk{};
  const ssize_t count = read(pipe_, chunk.data(), chunk.size());
  return {chunk.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

bool ChildProcess::succeeded() {
  close_pipe();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    core::throw_if_stopped();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  core::throw_if_stopped();
  return false;
}

}  // namespace fanbeam::core
