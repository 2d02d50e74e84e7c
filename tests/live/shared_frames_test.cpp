// Frames in shared memory, read back by the documented layout alone.
#include "live/shared_frames.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
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
    std::vector<std::uint8_t> both = pixels(slot + 192, 2 * 164 * 524);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (before % 2 != 0 || number(slot) != before) return std::nullopt;
    return std::pair(before / 2, std::move(both));
  }
  std::vector<std::uint8_t> pixels(std::size_t offset, std::size_t count) const {
    return {memory_ + offset, memory_ + offset + count};
  }
  std::size_t bytes() const { return bytes_; }

  unsigned mode_ = 0;

 private:
  const std::uint8_t* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace

namespace {

// Of hivision, with a C-scope of fewer rows than the B-scope, so that nothing in the header is said twice.
sensors::Sensor low_sensor() {
  sensors::Sensor low = sensor();
  low.display.cscope_rows = 300;
  return low;
}

// No value of which is 0 or another one's, and no pixel of which is its neighbour's or the other picture's.
live::LiveFrame particular_frame(std::uint64_t number) {
  live::LiveFrame frame = frame_of(number);
  frame.pose.position = {0.9, 0.2, 300.0};
  frame.pose.q_NB = core::quaternion_from({0.1, -0.05, 2.5});
  frame.frame_ms = 41.0;
  frame.pose_age_ms = 67.0;
  frame.began_s = 1234.5;
  frame.samples = 4.0;
  frame.outside_volume = true;
  frame.cscope_top_rad = -0.0175;
  frame.low_dB = -40.0;
  frame.high_dB = 3.0;
  frame.errors = live::PictureErrors{1.5, 2.5};
  const auto picture = [](int rows, std::size_t step, std::size_t modulus) {
    core::Picture8 result{164, rows, {}};
    for (std::size_t i = 0; i < 164 * static_cast<std::size_t>(rows); ++i)
      result.pixels.push_back(static_cast<std::uint8_t>((step * i + step) % modulus));
    return result;
  };
  frame.bscope = picture(524, 7, 251);
  frame.cscope = picture(300, 13, 241);
  return frame;
}

}  // namespace

// A line for each row of the first table of docs/live.md.
TEST_CASE("The header of shared memory is what its table says, for its owner alone",
          "[shared_frames]") {
  const std::string name = own_name();
  {
    SharedFrames frames(name, low_sensor(), 17.5);
    const Reader reader(name);
    CHECK(reader.mode_ == 0600);
    const auto whole = [&](std::size_t at) { return reader.at<std::uint32_t>(at); };
    const auto number = [&](std::size_t at) { return reader.at<double>(at); };
    using Numbers = std::vector<double>;
    using Wholes = std::vector<std::uint32_t>;
    CHECK(reader.at<std::array<char, 8>>(0) ==
          std::array<char, 8>{'F', 'A', 'N', 'B', 'E', 'A', 'M', '\0'});
    constexpr std::uint32_t kSlot_bytes = (192 + 164 * (524 + 300) + 63) / 64 * 64;
    CHECK(Wholes{whole(8), whole(12), whole(16), whole(20)} == Wholes{2, 256, 8, kSlot_bytes});
    CHECK(Wholes{whole(24), whole(28), whole(32), whole(36)} == Wholes{164, 524, 164, 300});
    CHECK(Numbers{number(40), number(48), number(56)} ==
          Numbers{200.0, 6.67, low_sensor().scan.field_of_view_rad});
    CHECK(Numbers{number(64), number(72)} ==
          Numbers{low_sensor().display.cscope_top_rad, low_sensor().display.cscope_span_rad});
    CHECK(Numbers{number(80), number(88), number(96)} == Numbers{-55.0, 5.0, 17.5});
    CHECK(reader.number(104) == 0);
    const auto text = reader.at<std::array<char, 256 - 112>>(112);
    REQUIRE(std::find(text.begin(), text.end(), '\0') != text.end());
    const std::string units = text.data();
    CHECK(units.starts_with("range:m,angle:rad,"));
    const std::string document = core::read_file(FANBEAM_SOURCE_DIR "/docs/live.md", 1U << 20U);
    CHECK(document.find("| 112 | text | units, ended by a zero: `" + units + "`;") !=
          std::string::npos);
    CHECK(reader.bytes() == 256 + 8 * std::size_t{kSlot_bytes});
    frames.write(particular_frame(21));
    CHECK(Numbers{number(64), number(72)} ==
          Numbers{-0.0175, low_sensor().display.cscope_span_rad});
    CHECK(Numbers{number(80), number(88), number(96)} == Numbers{-40.0, 3.0, 17.5});
    CHECK(reader.number(104) == 21);
  }
  CHECK(access(("/dev/shm/" + name).c_str(), F_OK) != 0);
}

// A line for each row of the second.
TEST_CASE("A slot of shared memory is what its table says", "[shared_frames]") {
  const std::string name = own_name();
  SharedFrames frames(name, low_sensor(), 17.5);
  const Reader reader(name);
  auto early = particular_frame(13);
  early.errors = {};
  early.outside_volume = false;
  frames.write(early);
  const std::size_t slot = 256 + 21 % 8 * reader.at<std::uint32_t>(20);
  const auto number = [&](std::size_t at) { return reader.at<double>(slot + at); };
  using Numbers = std::vector<double>;
  CHECK(number(96) == 0.0);
  CHECK(Numbers{number(128), number(136)} == Numbers{-1.0, -1.0});  // not known yet
  const auto frame = particular_frame(21);                          // in the same slot
  frames.write(frame);
  CHECK(reader.at<std::uint64_t>(slot) == 42);
  CHECK(reader.at<std::uint64_t>(slot + 8) == 21);
  CHECK(number(16) == 21.0 / 16.0);
  CHECK(Numbers{number(24), number(32), number(40)} == Numbers{0.9, 0.2, 300.0});
  CHECK(number(48) == Approx(0.1).epsilon(1e-12));
  CHECK(number(56) == Approx(-0.05).epsilon(1e-12));
  CHECK(number(64) == Approx(2.5).epsilon(1e-12));
  CHECK(Numbers{number(72), number(80), number(88), number(96)} ==
        Numbers{1e-3 * 41.0, 1e-3 * 67.0, 4.0, 1.0});
  CHECK(Numbers{number(104), number(112), number(120)} == Numbers{-0.0175, -40.0, 3.0});
  CHECK(Numbers{number(128), number(136), number(144)} == Numbers{1.5, 2.5, 1234.5});
  CHECK(reader.pixels(slot + 192, 164 * 524) == frame.bscope.pixels);
  CHECK(reader.pixels(slot + 192 + 164 * 524, 164 * 300) == frame.cscope.pixels);
}

TEST_CASE("The newest frame of many is whole, in the slot of its number", "[shared_frames]") {
  const std::string name = own_name();
  SharedFrames frames(name, sensor(), 16.0);
  const Reader reader(name);
  for (std::uint64_t number = 1; number <= 20; ++number) frames.write(frame_of(number));
  const auto newest = reader.newest();
  REQUIRE(newest.has_value());
  CHECK(newest->first == 20);
  CHECK(newest->second == std::vector<std::uint8_t>(2 * 164 * 524, 20));
  CHECK(frames.newest() == 20);
  for (std::uint64_t number = 13; number <= 20; ++number)
    CHECK(reader.at<std::uint64_t>(256 + number % 8 * reader.at<std::uint32_t>(20) + 8) == number);
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
