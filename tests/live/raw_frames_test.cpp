// Raw pictures into files and pipes.
#include "live/raw_frames.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "core/errors.h"
#include "core/stop.h"
#include "live/frame_taker.h"
#include "live/mailbox.h"
#include "live/wiring/sinks.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;
using live::RawFrames;

namespace {

std::shared_ptr<const live::LiveFrame> raw_frame(std::uint64_t number, std::size_t size) {
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = number;
  frame->bscope.pixels.assign(size, static_cast<std::uint8_t>(number));
  frame->cscope.pixels.assign(size, static_cast<std::uint8_t>(100 + number));
  return frame;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("Where every frame is wanted, the file holds all pictures one after the other",
          "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "frames.raw";
  {
    RawFrames raw(RawFrames::Scope::cscope, file.string(), true);
    const auto second = raw_frame(2, 2);
    for (const auto& frame : {raw_frame(1, 2), second, second, raw_frame(3, 2)}) raw.write(frame);
    raw.write(raw_frame(3, 2));  // of another scene
    CHECK_FALSE(raw.ended());
  }
  CHECK(bytes_of(file) == "eeffgggg");  // 101, 102, 103
}

TEST_CASE("A picture that is shown once more as a stale one is written once", "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "stale.raw";
  {
    RawFrames raw(RawFrames::Scope::bscope, file.string(), true);
    for (const std::uint64_t number : {65U, 66U, 67U}) {
      auto frame = std::make_shared<live::LiveFrame>(*raw_frame(number, 2));
      frame->stale = number == 66;
      raw.write(frame);
    }
  }
  CHECK(bytes_of(file) == "AACC");
}

TEST_CASE("F15 a reader that stands still holds nobody up, and gets whole pictures later",
          "[raw_frames][threads]") {
  const tests::TemporaryFolder folder;
  const auto pipe = (folder.path() / "pipe").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  constexpr std::size_t kSize = 100'000;  // more than a pipe holds
  RawFrames raw(RawFrames::Scope::bscope, pipe, false);
  raw.write(raw_frame(1, kSize));
  pollfd begun{reader, POLLIN, 0};
  REQUIRE(::poll(&begun, 1, 10'000) == 1);
  const auto begin = live::Clock::now();
  // Who waited for the reader would wait for ever.
  for (std::uint64_t number = 2; number <= 50; ++number) raw.write(raw_frame(number, kSize));
  CHECK(live::seconds_between(begin, live::Clock::now()) < 5.0);
  std::string got;
  char bytes[65536];
  for (int i = 0; i < 2000 && got.size() < 2 * kSize; ++i) {
    const ssize_t count = ::read(reader, bytes, sizeof bytes);
    if (count > 0)
      got.append(bytes, static_cast<std::size_t>(count));
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(got.size() == 2 * kSize);
  CHECK(got.find_first_not_of(got[0]) == kSize);  // whole,
  CHECK(got[kSize] == 50);                        // then the newest, those between missed
  CHECK(got.find_first_not_of(got[kSize], kSize) == std::string::npos);
  ::close(reader);
}

TEST_CASE("The end of the flight cuts no picture in a file", "[raw_frames][threads]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "frames.raw";
  constexpr std::size_t kSize = 20'000'000;  // far from written when the end comes
  {
    RawFrames raw(RawFrames::Scope::bscope, file.string(), false);
    raw.write(raw_frame(1, kSize));
    while (std::filesystem::file_size(file) == 0) std::this_thread::yield();
  }
  CHECK(std::filesystem::file_size(file) == kSize);
}

TEST_CASE("Where time is up a slow reader gets the picture to its end; a signal leaves it at once",
          "[raw_frames][threads]") {
  const tests::TemporaryFolder folder;
  constexpr std::size_t kSize = 100'000;  // more than a pipe holds
  for (const auto& [reason, every_frame] : {std::pair{live::kTimeIsUp, true},
                                            {SIGINT, true},
                                            {live::kTimeIsUp, false},
                                            {SIGINT, false}}) {
    INFO(reason << ", every frame " << every_frame);
    const auto pipe =
        (folder.path() / (std::to_string(reason) + std::to_string(every_frame))).string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    core::StopSource end;
    std::size_t got = 0;
    std::thread slow([&, why = reason] {
      char bytes[65536];
      pollfd begun{reader, POLLIN, 0};
      ::poll(&begun, 1, 10'000);
      end.request(why);
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      for (ssize_t count = 1; count != 0;) {
        count = ::read(reader, bytes, sizeof bytes);
        if (count > 0)
          got += static_cast<std::size_t>(count);
        else if (count < 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
    {
      const core::StopToken token = end.token();
      const core::StopScope scope(token);
      RawFrames raw(RawFrames::Scope::bscope, pipe, every_frame);
      raw.write(raw_frame(1, kSize));
      while (token.reason() == 0) std::this_thread::yield();  // the picture is under way
    }
    slow.join();
    ::close(reader);
    if (reason == SIGINT)
      CHECK(got < kSize);
    else
      CHECK(got == kSize);
  }
}

TEST_CASE("A reader that leaves ends the pictures, not the program", "[raw_frames][threads]") {
  std::signal(SIGPIPE, SIG_IGN);
  const tests::TemporaryFolder folder;
  const auto pipe = (folder.path() / "pipe").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  RawFrames raw(RawFrames::Scope::bscope, pipe, true);
  raw.write(raw_frame(1, 10));
  ::close(reader);
  raw.write(raw_frame(2, 10));
  CHECK(raw.ended());
  CHECK_NOTHROW(raw.close());
}

TEST_CASE("What the system refuses to write is told at the end", "[raw_frames][threads]") {
  for (const bool every_frame : {true, false}) {
    RawFrames raw(RawFrames::Scope::bscope, "/dev/full", every_frame);
    raw.write(raw_frame(1, 10));
    for (int i = 0; i < 500 && !raw.ended(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(raw.ended());
    try {
      raw.close();
      FAIL("a full disk is none");
    } catch (const core::InputError& error) {
      CHECK(error.problems().at(0).code == "E-IO");
      CHECK(error.problems().at(0).place.file == "/dev/full");
    }
  }
}

TEST_CASE("A file that cannot be written is told", "[raw_frames]") {
  CHECK_THROWS_AS(RawFrames(RawFrames::Scope::bscope, "/nonexistent/frames", false),
                  core::InputError);
}

TEST_CASE("A pipe gets frames from when it has a reader", "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto pipe = (folder.path() / "pipe").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  RawFrames raw(RawFrames::Scope::bscope, pipe, false);
  raw.write(raw_frame(1, 4));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK_FALSE(raw.ended());
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  raw.write(raw_frame(2, 4));
  pollfd ready{reader, POLLIN, 0};
  REQUIRE(::poll(&ready, 1, 5000) == 1);
  char bytes[8] = {};
  CHECK(::read(reader, bytes, sizeof bytes) == 4);
  CHECK(bytes[0] == 2);
  ::close(reader);
}

TEST_CASE("A file is as it was until its flight begins, and one that was made goes with it",
          "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto old = folder.write("old.raw", "kept"), made = folder.path() / "new.raw";
  {
    RawFrames raw(RawFrames::Scope::bscope, old.string(), true);
    const RawFrames other(RawFrames::Scope::bscope, made.string(), true);
    CHECK(std::filesystem::exists(made));
    // Who writes it has it alone.
    CHECK_THROWS_AS(RawFrames(RawFrames::Scope::cscope, old.string(), true), core::InputError);
  }
  CHECK(bytes_of(old) == "kept");
  CHECK_FALSE(std::filesystem::exists(made));
  RawFrames raw(RawFrames::Scope::bscope, old.string(), true);
  raw.begin();
  CHECK(bytes_of(old).empty());
}

// A pipe has no lock that would tell so, as a file has.
TEST_CASE("One file or pipe for two pictures is refused, whatever names it goes by",
          "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe", linked = folder.path() / "linked";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  std::filesystem::create_symlink(pipe, linked);
  const auto below = [&](const char* name) { return folder.path().string() + "/" + name; };
  const auto refused = [](const std::string& first, const std::string& second) {
    live::FramesTo to;
    live::add_sink("raw-bscope:" + first, to);
    try {
      live::add_sink("raw-cscope:" + second, to);
      return false;
    } catch (const core::InputError&) {
      return true;
    }
  };
  CHECK(refused(below("pipe"), below("pipe")));
  CHECK(refused(below("pipe"), below("./pipe")));
  CHECK(refused(below("linked"), below("pipe")));
  CHECK(refused(below("none/../film.raw"), below("film.raw")));  // not there yet
  CHECK(refused("film.raw", "./film.raw"));
  CHECK(refused("-", "-"));
  CHECK(refused("-", "/dev/stdout"));
  CHECK_FALSE(refused("-", "./-"));
  CHECK_FALSE(refused(below("pipe"), below("film.raw")));
  CHECK_FALSE(refused("film.raw", "other.raw"));
}

// The reader went on in the middle of a picture, with another size.
TEST_CASE("A scene whose pictures are of another size is refused where raw video is written",
          "[raw_frames]") {
  const tests::TemporaryFolder folder;
  const auto scene = tests::live_session(folder)->scene()->description;
  for (const bool bscope : {true, false}) {
    INFO(bscope);
    live::FramesTo to;
    live::add_sink((bscope ? "raw-bscope:" : "raw-cscope:") + (folder.path() / "film").string(),
                   to);
    live::Sinks sinks(to, true);
    sinks.begin(scene, 16.0);
    CHECK_NOTHROW(sinks.check_raw_size(scene));
    scenes::SceneDescription rows = scene, columns = scene;
    (bscope ? rows.sensor.range.cells : rows.sensor.display.cscope_rows) += 1;
    columns.sensor.scan.columns -= 1;
    for (const auto& other : {rows, columns}) {
      try {
        sinks.check_raw_size(other);
        FAIL("taken");
      } catch (const core::InputError& error) {
        CHECK(error.problems().at(0).code == "E-UNSUPPORTED");
        CHECK(error.problems().at(0).expected.find("164x524") != std::string::npos);
      }
    }
    // The other picture is none of theirs.
    scenes::SceneDescription beside = scene;
    (bscope ? beside.sensor.display.cscope_rows : beside.sensor.range.cells) += 1;
    CHECK_NOTHROW(sinks.check_raw_size(beside));
  }
}
