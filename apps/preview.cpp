#include "apps/preview.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "core/stop.h"

extern char** environ;

namespace fanbeam::apps {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "preview", reason,
                          "a working ffmpeg program (Debian package ffmpeg)");
}

}  // namespace

Preview::Preview(std::filesystem::path file, int columns, int rows, double frame_rate_Hz)
    : file_(std::move(file)),
      temporary_(file_.parent_path() / (".preview.tmp" + file_.extension().string())) {
  std::filesystem::create_directories(file_.parent_path());
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) refuse(file_, "no pipe");
  std::signal(SIGPIPE, SIG_IGN);  // a dying ffmpeg shows as a failed write
  std::vector<std::string> words = {"ffmpeg",   "-loglevel",
                                    "error",    "-y",
                                    "-f",       "rawvideo",
                                    "-pix_fmt", "gray",
                                    "-s",       fmt::format("{}x{}", columns, rows),
                                    "-r",       fmt::format("{}", frame_rate_Hz),
                                    "-i",       "-"};
  if (file_.extension() == ".mp4")
    for (const char* word :
         {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"})
      words.emplace_back(word);
  words.push_back(temporary_.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int failed =
      posix_spawnp(&process_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (failed != 0) {
    process_ = 0;
    close(pipe_);
    pipe_ = -1;
    refuse(file_, "ffmpeg cannot be started");
  }
}

Preview::~Preview() {
  if (pipe_ >= 0) close(pipe_);
  if (process_ > 0) {  // not finished: nobody wants what it has
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void Preview::add(const core::Picture8& picture) {
  std::size_t sent = 0;
  while (sent < picture.pixels.size()) {
    const ssize_t count = write(pipe_, picture.pixels.data() + sent, picture.pixels.size() - sent);
    if (count <= 0) refuse(file_, "ffmpeg stopped reading");
    sent += static_cast<std::size_t>(count);
  }
}

void Preview::finish() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    core::throw_if_stopped();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = 0;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) refuse(file_, "ffmpeg failed");
  std::filesystem::rename(temporary_, file_);
}

}  // namespace fanbeam::apps
