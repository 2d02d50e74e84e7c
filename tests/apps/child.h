// The fanbeam program as a process that runs beside the test: watched, and stopped by signals.
#pragma once

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace fanbeam::tests {

inline void wait_ms(double time_ms) {
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(time_ms));
}

class Child {
 public:
  // With a terminal, what the program writes to it is kept.
  explicit Child(const std::vector<std::string>& words, bool terminal = false) {
    process_ = terminal ? forkpty(&terminal_, nullptr, nullptr, nullptr) : fork();
    REQUIRE(process_ >= 0);
    if (process_ > 0) return;
    if (!terminal) {
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int descriptor : {0, 1, 2}) dup2(nowhere, descriptor);
    }
    std::signal(SIGINT, SIG_DFL);  // a job in the background inherits it ignored
    std::vector<std::string> all = {FANBEAM_BINARY_DIR "/bin/fanbeam"};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& word : all) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ~Child() {
    if (process_ > 0) kill(process_, SIGKILL);
    wait();
    if (terminal_ >= 0) close(terminal_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { kill(process_, signal); }
  // Ctrl-C on its terminal, which strikes every process of the group in the foreground.
  void interrupt() const { REQUIRE(::write(terminal_, "\x03", 1) == 1); }

  // Ctrl-S: its terminal takes no more.
  void hold_terminal() const { REQUIRE(::write(terminal_, "\x13", 1) == 1); }

  bool running() {
    if (process_ > 0 && waitpid(process_, &status_, WNOHANG) == process_) process_ = 0;
    return process_ > 0;
  }
  // Until it has ended; the raw status.
  int wait() {
    read_terminal();
    if (process_ > 0) waitpid(process_, &status_, 0);
    process_ = 0;
    return status_;
  }

  // Which render does from the first frame on, live before it opens its scene.
  void wait_until_it_handles_signals() {
    while (running() && !(is_program() && (field("SigCgt:", 16) & (1ULL << (SIGTERM - 1))) != 0))
      wait_ms(2.0);
    REQUIRE(running());
  }

  // No copy of the test any more, whose handlers it had.
  bool is_program() const {
    std::string name;
    std::ifstream("/proc/" + std::to_string(process_) + "/comm") >> name;
    return name == "fanbeam";
  }

  // Of /proc: "VmRSS:" in kB, "Threads:".
  std::uint64_t field(const std::string& name, int base = 10) const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string word; status >> word;)
      if (word == name && status >> word) return std::stoull(word, nullptr, base);
    return 0;
  }
  std::size_t descriptors() const {
    std::error_code gone;
    std::size_t count = 0;
    for (std::filesystem::directory_iterator
             entry("/proc/" + std::to_string(process_) + "/fd", gone),
         end;
         !gone && entry != end; entry.increment(gone))
      ++count;
    return count;
  }

  const std::string& written() const { return written_; }

 private:
  void read_terminal() {
    char chunk[4096];
    while (terminal_ >= 0) {
      const ssize_t count = read(terminal_, chunk, sizeof chunk);
      if (count <= 0) return;  // EIO when the other side is closed
      written_.append(chunk, static_cast<std::size_t>(count));
    }
  }

  pid_t process_ = -1;
  int terminal_ = -1, status_ = 0;
  std::string written_;
};

}  // namespace fanbeam::tests
