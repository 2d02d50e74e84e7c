// Frames in shared memory, read back by the documented layout alone.
#include "live/shared_frames.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "core/errors.h"
#include "core/files.h"
#include "sensors/sensor_file.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
using live::SharedFrames;

namespace {

sensors::Sensor sensor() {
  core::ProblemList problems;
  return sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", problems);
}

std::string own_name() { return "fanbeam_test_" + std::to_string(getpid()); }

live::LiveFrame frame_of(std::uint64_t number) {
  live::LiveFrame frame;
  frame.number = number;
  frame.pose.time_s = static_cast<double>(number) / 16.0;
  frame.pose.position = {0.9, 0.2, 300.0};
  frame.samples = 4.0;
  const std::vector<std::uint8_t> pixels(164 * 524, static_cast<std::uint8_t>(number));
  frame.bscope = frame.cscope = {164, 524, pixels};
  return frame;
}

// What any other program has: the file, and the layout of docs/live.md.
class Reader {
 public:
  explicit Reader(const std::string& name) {
    const int file = open(("/dev/shm/" + name).c_str(), O_RDONLY);
    REQUIRE(file >= 0);
    struct stat facts {};
    REQUIRE(fstat(file, &facts) == 0);
    bytes_ = static_cast<std::size_t>(facts.st_size);
    mode_ = facts.st_mode & 0777;
    memory_ =
        static_cast<const std::uint8_t*>(mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0));
    close(file);
  }
  ~Reader() { munmap(const_cast<std::uint8_t*>(memory_), bytes_); }

  template <class T>
  T at(std::size_t offset) const {
    T value{};
    std::memcpy(&value, memory_ + offset, sizeof value);
    return value;
  }
  std::uint64_t number(std::size_t offset) const {
    const auto* word = reinterpret_cast<const std::uint64_t*>(memory_ + offset);
    return __atomic_load_n(word, __ATOMIC_ACQUIRE);
  }
  // The newest frame's number and pixels; nothing when it was written over meanwhile.
  std::optional<std::pair<std::uint64_t, std::vector<std::uint8_t>>> newest() const {
    const std::uint64_t frame = number(104);
    const std::size_t slot = 256 + frame % at<std::uint32_t>(16) * at<std::uint32_t>(20);
    const std::uint64_t before = number(slot);
    std::vector<std::uint8_t> pixels(memory_ + slot + 192, memory_ + slot + 192 + 2 * 164 * 524);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (before % 2 != 0 || number(slot) != before) return std::nullopt;
    return std::pair(before / 2, std::move(pixels));
  }

  unsigned mode_ = 0;

 private:
  const std::uint8_t* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace

TEST_CASE("Shared memory holds what its layout says, for its owner alone", "[shared_frames]") {
  const std::string name = own_name();
  {
    SharedFrames frames(name, sensor(), 16.0);
    const Reader reader(name);
    CHECK(reader.mode_ == 0600);
    CHECK(reader.at<std::array<char, 8>>(0) ==
          std::array<char, 8>{'F', 'A', 'N', 'B', 'E', 'A', 'M', '\0'});
    CHECK(reader.at<std::uint32_t>(8) == 2);
    CHECK(reader.at<std::uint32_t>(24) == 164);
    CHECK(reader.at<std::uint32_t>(28) == 524);
    CHECK(reader.at<double>(40) == 200.0);
    CHECK(reader.at<double>(48) == 6.67);
    CHECK(reader.at<double>(80) == -55.0);
    CHECK(reader.at<double>(96) == 16.0);
    CHECK(reader.number(104) == 0);
    for (std::uint64_t number = 1; number <= 20; ++number) frames.write(frame_of(number));
    const auto newest = reader.newest();
    REQUIRE(newest.has_value());
    CHECK(newest->first == 20);
    CHECK(newest->second == std::vector<std::uint8_t>(2 * 164 * 524, 20));
    const std::size_t slot = 256 + 20 % 8 * reader.at<std::uint32_t>(20);
    CHECK(reader.at<std::uint64_t>(slot + 8) == 20);
    CHECK(reader.at<double>(slot + 16) == 1.25);
    CHECK(reader.at<double>(slot + 24) == 0.9);
    CHECK(reader.at<double>(slot + 40) == 300.0);
    CHECK(reader.at<double>(slot + 88) == 4.0);
    CHECK(reader.at<double>(slot + 128) == -1.0);  // not known yet
    CHECK(reader.at<double>(slot + 136) == -1.0);
    // What a control moved: of the frame, and of the newest.
    auto moved = frame_of(21);
    moved.cscope_top_rad = -0.0175;
    moved.low_dB = -40.0;
    moved.high_dB = 1.0;
    moved.errors = live::PictureErrors{1.5, 2.5};
    frames.write(moved);
    const std::size_t next = 256 + 21 % 8 * reader.at<std::uint32_t>(20);
    CHECK(reader.at<double>(next + 128) == 1.5);
    CHECK(reader.at<double>(next + 136) == 2.5);
    for (const std::size_t at : {next + 104, std::size_t{64}})
      CHECK(reader.at<double>(at) == -0.0175);
    for (const std::size_t at : {next + 112, std::size_t{80}}) {
      CHECK(reader.at<double>(at) == -40.0);
      CHECK(reader.at<double>(at + 8) == 1.0);
    }
  }
  CHECK(access(("/dev/shm/" + name).c_str(), F_OK) != 0);
}

TEST_CASE("No reader ever takes a torn frame", "[shared_frames]") {
  const std::string name = own_name();
  SharedFrames frames(name, sensor(), 16.0);
  frames.write(frame_of(1));
  std::atomic<bool> done{false};
  std::atomic<int> taken{0}, torn{0};
  std::thread watcher([&] {
    const Reader reader(name);
    std::uint64_t last = 0;
    while (!done) {
      const auto newest = reader.newest();
      if (!newest) continue;
      ++taken;
      const auto wanted = static_cast<std::uint8_t>(newest->first);
      for (const std::uint8_t pixel : newest->second) torn += pixel != wanted;
      torn += newest->first < last;
      last = newest->first;
    }
  });
  // For as long as the watcher needs on a busy machine.
  for (std::uint64_t number = 2; number <= 2000 || (taken <= 10 && number < 1'000'000); ++number)
    frames.write(frame_of(number));
  done = true;
  watcher.join();
  CHECK(taken > 10);
  CHECK(torn == 0);
}

TEST_CASE("A name in use is refused, one that a dead process left is taken over",
          "[shared_frames]") {
  const std::string name = own_name();
  for (const char* bad : {"", "a/b", "../x", ".hidden", "with space"})
    CHECK_THROWS_AS(SharedFrames(bad, sensor(), 16.0), core::InputError);
  {
    const SharedFrames first(name, sensor(), 16.0);
    CHECK_THROWS_AS(SharedFrames(name, sensor(), 16.0), core::InputError);
    CHECK(Reader(name).number(104) == 0);  // untouched
  }
  const std::string left = "/dev/shm/" + name;
  std::ofstream(left) << "left behind";
  REQUIRE(chmod(left.c_str(), 0600) == 0);
  SharedFrames second(name, sensor(), 16.0);
  second.write(frame_of(3));
  CHECK(Reader(name).newest()->first == 3);
}

// It was gone with the first, whose name it no longer was.
TEST_CASE("A name that was taken away and is another's by now stays with that one",
          "[shared_frames]") {
  const std::string name = own_name(), file = "/dev/shm/" + name;
  {
    auto first = std::make_unique<SharedFrames>(name, sensor(), 16.0);
    REQUIRE(shm_unlink(("/" + name).c_str()) == 0);
    SharedFrames second(name, sensor(), 16.0);
    second.write(frame_of(5));
    first.reset();
    REQUIRE(access(file.c_str(), F_OK) == 0);
    CHECK(Reader(name).newest()->first == 5);
  }
  CHECK(access(file.c_str(), F_OK) != 0);
}

// Whoever put it there could read frames, and write over them.
TEST_CASE("A file that others may open, or that is another user's, is refused and left alone",
          "[shared_frames]") {
  const std::string name = own_name(), file = "/dev/shm/" + name;
  const auto refusal = [&] {
    try {
      const SharedFrames frames(name, sensor(), 16.0);
    } catch (const core::InputError& error) {
      return error.problems().at(0).code + " " + error.problems().at(0).value;
    }
    return std::string("taken");
  };
  std::ofstream(file).close();
  for (const mode_t mode : {0666U, 0640U, 0604U}) {
    REQUIRE(chmod(file.c_str(), mode) == 0);
    CHECK(refusal().starts_with("E-IO a file of user "));
    CHECK(access(file.c_str(), F_OK) == 0);
  }
  REQUIRE(chmod(file.c_str(), 0600) == 0);
  constexpr uid_t kNobody = 65534;
  if (geteuid() == 0 && chown(file.c_str(), kNobody, kNobody) == 0) {
    CHECK(refusal().starts_with("E-IO"));
    CHECK(access(file.c_str(), F_OK) == 0);
    REQUIRE(chown(file.c_str(), 0, 0) == 0);
  }
  CHECK(refusal() == "taken");
}

namespace {

// The lines of docs/live.md between two that are so, indented or not, for the memory of that name.
std::string program_of(const std::string& first, const std::string& last, const std::string& name) {
  std::string text = core::read_file(FANBEAM_SOURCE_DIR "/docs/live.md", 1U << 20U);
  const std::size_t begin = text.find(first), end = text.find(last, begin);
  REQUIRE(begin != std::string::npos);
  REQUIRE(end != std::string::npos);
  text = text.substr(begin, end - begin);
  for (std::size_t at = 0; (at = text.find("/dev/shm/radar", at)) != std::string::npos;)
    text.replace(at, 14, "/dev/shm/" + name);
  return text;
}

// What the program prints, while frames are written without a pause whose pixels are the last byte of
// their number.
std::vector<std::string> lines_of(const std::string& command, SharedFrames& frames) {
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t number = 1; !done; ++number) frames.write(frame_of(number));
  });
  std::FILE* program = popen(("timeout 40 " + command + " 2>/dev/null").c_str(), "r");
  std::vector<std::string> lines;
  char line[200] = "";
  while (program != nullptr && lines.size() < 12 &&
         std::fgets(line, sizeof line, program) != nullptr)
    lines.emplace_back(line);
  if (program != nullptr) pclose(program);
  done = true;
  writer.join();
  return lines;
}

}  // namespace

TEST_CASE("The readers of the documents, in C and Python, take whole frames", "[shared_frames]") {
  const std::string name = own_name();
  const tests::TemporaryFolder folder;
  folder.write("reader.c", program_of("#include <fcntl.h>", "```\n\n## Security", name));
  std::string python = program_of("    import mmap", "| Offset |", name), straight;
  for (std::size_t at = 0; at < python.size(); at = python.find('\n', at) + 1)
    if (python.compare(at, 4, "    ") == 0)
      straight += python.substr(at + 4, python.find('\n', at) + 1 - at - 4);
  folder.write("reader.py", straight);
  const std::string c = (folder.path() / "reader").string(), source = c + ".c";
  REQUIRE(std::system(("cc -O2 -Wall -Wextra -Werror -o " + c + " " + source).c_str()) == 0);
  for (const std::string& command : {c, "/usr/bin/python3 -u " + c + ".py"}) {
    SharedFrames frames(name, sensor(), 16.0);
    const std::vector<std::string> lines = lines_of(command, frames);
    CHECK(lines.size() == 12);
    for (const std::string& line : lines) {
      INFO(command << ": " << line);
      unsigned long long number = 0;
      double mean = -1.0;
      REQUIRE(std::sscanf(line.c_str(), "%llu %lf", &number, &mean) == 2);
      CHECK(number > 0);
      CHECK(mean == static_cast<double>(number % 256));
    }
  }
}
