// A render that is stopped or killed leaves whole files, and --resume makes of them what an
// uninterrupted run would have made.
#include <chrono>

#include "core/random.h"
#include "tests/apps/busy_scene.h"
#include "tests/apps/child.h"
#include "tests/core/left_temporary.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
using Files = std::map<std::string, std::string>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kLatest_s = 20.0;  // what is instrumented runs ten times as long
#else
constexpr double kLatest_s = 1.0;
#endif

const std::string kBusyFrames = " -q --frames 0:60:5 --rays-per-cell 4" + kAllPictures;

std::vector<std::string> split(const std::string& words) {
  std::istringstream stream(words);
  std::vector<std::string> parts;
  for (std::string word; stream >> word;) parts.push_back(word);
  return parts;
}

std::vector<std::string> render_words(const fs::path& scene, const fs::path& out,
                                      const std::string& more) {
  std::vector<std::string> words = {"render", scene.string(), "-o", out.string()};
  for (const std::string& word : split(more)) words.push_back(word);
  return words;
}

bool is_hidden(const std::string& name) { return fs::path(name).filename().string()[0] == '.'; }

// Every file with a final name is one of the uninterrupted run, byte for byte.
void check_whole(const fs::path& out, const Files& reference) {
  if (!fs::exists(out)) return;
  for (const auto& [name, bytes] : contents(out)) {
    if (fs::is_directory(out / name) || is_hidden(name) || name == "timing.json") continue;
    INFO(name);
    REQUIRE(reference.contains(name));
    CHECK((bytes == reference.at(name)));
  }
}

std::size_t leftovers(const fs::path& out) {
  std::size_t count = 0;
  if (fs::exists(out))
    for (const auto& [name, bytes] : contents(out))
      if (is_hidden(name)) ++count;
  return count;
}

double stop(Child& child, int signal) {
  const auto begin = Clock::now();
  child.send(signal);
  const int status = child.wait();
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == signal);
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

TEST_CASE("SIGTERM and SIGINT end a render within a second and leave whole frames to resume",
          "[stop]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  const fs::path whole = folder.path() / "whole";
  render(quoted(folder.path()), whole, kBusyFrames);
  const Files reference = results(whole);
  for (const int signal : {SIGTERM, SIGINT}) {
    const fs::path out = folder.path() / ("out" + std::to_string(signal));
    {
      Child child(render_words(folder.path(), out, kBusyFrames));
      child.wait_until_it_handles_signals();
      while (child.running() && !fs::exists(out / "power")) wait_ms(1.0);
      CHECK(stop(child, signal) < kLatest_s);
    }
    CHECK(leftovers(out) == 0);
    CHECK_FALSE(fs::exists(out / "run.json"));
    check_whole(out, reference);
    render(quoted(folder.path()), out, kBusyFrames + " --resume");
    CHECK((results(out) == reference));
  }
}

TEST_CASE("A signal also ends a frame that takes seconds, and ffmpeg beside it", "[stop]") {
  const TemporaryFolder folder;
  const bool has_ffmpeg = std::system("ffmpeg -version >/dev/null 2>&1") == 0;
  const fs::path out = folder.path() / "out";
  Child child(render_words("obstacle-field", out,
                           std::string("-q --frames 100:200 --reference --products bscope,cscope") +
                               (has_ffmpeg ? ",preview" : "")));
  child.wait_until_it_handles_signals();
  wait_ms(300.0);  // into the frame
  CHECK(stop(child, SIGTERM) < kLatest_s);
  if (!fs::exists(out)) return;
  for (const auto& [name, bytes] : contents(out)) CHECK(fs::is_directory(out / name));
}

TEST_CASE("A stopped render ends the line of its progress bar", "[stop]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  const fs::path out = folder.path() / "out";
  Child child(render_words(folder.path(), out, "--frames 0:400 --rays-per-cell 4"), true);
  while (child.running() && !fs::exists(out / "bscope/00005.png")) wait_ms(1.0);
  stop(child, SIGINT);
  const std::string& text = child.written();
  INFO(text);
  CHECK(text.find(" frames/s") != std::string::npos);
  CHECK(text.find("left \r\nstopped: ") != std::string::npos);
  CHECK(text.ends_with("\n"));
}

TEST_CASE("Ctrl-C on a terminal stops a command and not gnuplot beside it, which would have failed",
          "[stop]") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", begun = folder.path() / "begun";
  fs::create_directories(folder.path() / "bin");
  folder.write("bin/gnuplot", "#!/bin/sh\ntouch " + quoted(begun) + "\nexec sleep 60\n");
  fs::permissions(folder.path() / "bin/gnuplot", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((folder.path() / "bin").string() + ":" + path).c_str(), 1);
  Child child({"fmcw", "street-76ghz", "--frames", "0", "--chirps", "64", "--products",
               "range-doppler", "-o", out.string()},
              true);
  setenv("PATH", path.c_str(), 1);
  while (child.running() && !fs::exists(begun)) wait_ms(1.0);
  child.interrupt();
  const int status = child.wait();
  INFO(child.written());
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
  CHECK(child.written().find("gnuplot") == std::string::npos);
  for (const auto& [name, bytes] : contents(out)) CHECK(name.find(".tmp") == std::string::npos);
}

TEST_CASE("A render killed at any moment leaves whole files, and --resume completes them",
          "[stop]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  const fs::path whole = folder.path() / "whole";
  const auto begin = Clock::now();
  render(quoted(folder.path()), whole, kBusyFrames);
  const double whole_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  const Files reference = results(whole);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const fs::path out = folder.path() / ("out" + std::to_string(seed));
    // Killed twice, the second time while it resumes.
    for (std::uint32_t turn = 0; turn < 2; ++turn) {
      Child child(render_words(folder.path(), out, kBusyFrames + (turn > 0 ? " --resume" : "")));
      wait_ms(whole_ms * core::uniform_from(core::random_words({19, 0, 0}, seed, turn)[0]));
      child.send(SIGKILL);
      child.wait();
      check_whole(out, reference);
    }
    render(quoted(folder.path()), out, kBusyFrames + " --resume");
    INFO("seed " << seed);
    CHECK(leftovers(out) == 0);
    CHECK((results(out) == reference));
  }
}

TEST_CASE("--resume removes what a killed run was writing, and nothing else", "[stop]") {
  const TemporaryFolder folder;
  write_busy_scene(folder);
  const fs::path out = folder.path() / "out";
  fs::create_directories(out / "bscope");
  pid_t gone = fork();
  if (gone == 0) _exit(0);
  waitpid(gone, nullptr, 0);
  const auto write = [&](const fs::path& name) {
    std::ofstream(out / name) << "half";
    return out / name;
  };
  const fs::path picture = write(temporary_of(gone, out / "bscope/00000.png"));
  const fs::path record = write(temporary_of(gone, out / "run.json"));
  const fs::path alive = write(core::temporary_beside(out / "bscope/00001.png"));
  write("bscope/.notes");
  write("bscope/mine.tmp.png");
  render(quoted(folder.path()), out, " -q --frames 0 --resume --overwrite");
  CHECK_FALSE(fs::exists(picture));
  CHECK_FALSE(fs::exists(record));
  CHECK(fs::exists(alive));
  CHECK(fs::exists(out / "bscope/.notes"));
  CHECK(fs::exists(out / "bscope/mine.tmp.png"));
}
