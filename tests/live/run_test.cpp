// A flight by the words of a command line, without the command.
#include "live/wiring/run.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "feeds/xplane.h"
#include "tests/live/file_size_limit.h"
#include "tests/live/live_scene.h"
#include "tests/live/loopback.h"
#include "tests/open_descriptor.h"

using namespace fanbeam;

TEST_CASE(
    "A run opens its scene, tells of its page and its frames, and ends after as many as asked",
    "[live]") {
  const tests::TemporaryFolder folder;
  const live::RunSettings settings{
      .http = "0", .rays_per_cell = 1.0, .lockstep = true, .frames = 2};
  std::vector<std::string> opened, shown;
  std::vector<std::uint64_t> frames;
  const auto heard = std::make_shared<int>();  // held by whoever hears of this scene
  const live::RunCallbacks calls{.open =
                                     [&](const std::string& scene) {
                                       opened.push_back(scene);
                                       return tests::live_session(folder);
                                     },
                                 .page =
                                     [&](const std::string& scene, std::uint16_t port) {
                                       CHECK(port != 0);  // of 0, any that is free
                                       CHECK(frames.empty());
                                       shown.push_back(scene);
                                     },
                                 .status =
                                     [&] {
                                       return
                                           [&frames, heard](const live::Status& now, int viewers) {
                                             CHECK(viewers == 0);
                                             frames.push_back(now.frames);
                                           };
                                     }};
  live::run_live(settings, live::wiring_of(settings, nullptr), nullptr, "here", calls);
  CHECK(opened == std::vector<std::string>{"here"});
  CHECK(shown == std::vector<std::string>{"test"});
  REQUIRE_FALSE(frames.empty());
  CHECK(frames.back() == 2);
  CHECK(heard.use_count() == 1);  // the scene is left, and so is who heard of it
}

namespace {

// A port of its own that hears what X-Plane is asked for.
class AskedSimulator {
 public:
  AskedSimulator() {
    port_ = ntohs(tests::bound_to_loopback(wire_).sin_port);
    const timeval patience{2, 0};
    REQUIRE(::setsockopt(wire_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) == 0);
  }
  ~AskedSimulator() { ::close(wire_); }
  AskedSimulator(const AskedSimulator&) = delete;
  AskedSimulator& operator=(const AskedSimulator&) = delete;

  std::uint16_t port() const { return port_; }
  // Whether that comes before it is silent for two seconds; what comes before is passed over.
  bool hears(const std::vector<std::uint8_t>& datagram) const {
    std::array<std::uint8_t, 2000> bytes{};
    for (ssize_t size = 0; (size = ::recv(wire_, bytes.data(), bytes.size(), 0)) >= 0;)
      if (std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + size) == datagram) return true;
    return false;
  }

 private:
  int wire_ = ::socket(AF_INET, SOCK_DGRAM, 0);
  std::uint16_t port_ = 0;
};

}  // namespace

// It went on sending, 16 times a second.
TEST_CASE("X-Plane is asked for no more when the flight ends with an error too", "[live]") {
  const tests::TemporaryFolder folder;
  const AskedSimulator simulator;
  const live::RunSettings settings{.from = {"xplane:127.0.0.1:" + std::to_string(simulator.port())},
                                   .http = "0"};
  const live::RunCallbacks calls{
      .open = [&](const std::string&) { return tests::live_session(folder); },
      .page = [](const std::string&, std::uint16_t) {},
      .status =
          [&] {
            return [&](const live::Status&, int) {
              CHECK(simulator.hears(feeds::xplane_position_request(16)));
              throw std::runtime_error("no room");
            };
          }};
  CHECK_THROWS_AS(
      live::run_live(settings, live::wiring_of(settings, nullptr), nullptr, "here", calls),
      std::runtime_error);
  CHECK(simulator.hears(feeds::xplane_position_request(0)));
}

TEST_CASE("The token of the environment counts where no file of one is named", "[live]") {
  const live::RunSettings settings{.http = "0.0.0.0:0"};  // beyond this machine
  CHECK_THROWS_AS(live::wiring_of(settings, nullptr), core::InputError);
  CHECK(live::wiring_of(settings, "0123456789abcdef").access.has_token());
  // Set to nothing is not set: it was a token too short, on this machine alone too.
  CHECK_FALSE(live::wiring_of({}, "").access.has_token());
  CHECK_THROWS_AS(live::wiring_of(settings, ""), core::InputError);
  // Too short, and told in the words of the environment.
  try {
    live::wiring_of({}, "short");
    FAIL("taken");
  } catch (const core::InputError& error) {
    CHECK(core::to_string(error.problems().front()).find(live::kTokenVariable) !=
          std::string::npos);
  }
}

namespace {

// What the page says to a control.
std::string answer_to_control(std::uint16_t port, const std::string& path,
                              const std::string& body) {
  const int wire = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  at.sin_port = htons(port);
  const std::string request = "POST " + path +
                              " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                              "\r\nConnection: close\r\nContent-Type: application/json\r\n"
                              "Content-Length: " +
                              std::to_string(body.size()) + "\r\n\r\n" + body;
  std::string answer;
  std::array<char, 2000> bytes{};
  if (::connect(wire, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0 &&
      ::send(wire, request.data(), request.size(), MSG_NOSIGNAL) ==
          static_cast<ssize_t>(request.size()))
    for (ssize_t size = 0; (size = ::recv(wire, bytes.data(), bytes.size(), 0)) > 0;)
      answer.append(bytes.data(), static_cast<std::size_t>(size));
  ::close(wire);
  return answer;
}

// The problems that a run ends with; none of one that ends well.
std::vector<core::Problem> problems_of_run(const live::RunSettings& settings,
                                           const live::RunCallbacks& calls) {
  try {
    live::run_live(settings, live::wiring_of(settings, nullptr), nullptr, "here", calls);
  } catch (const core::InputError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

// It went on, with a recording that nobody could read, to a good end.
TEST_CASE("A run ends with an error when a control of its page finds no room in the recording",
          "[live]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  const live::RunSettings settings{
      .from = {"native-fdm:0"}, .http = "0", .record = file.string(), .seconds = 20.0};
  std::optional<tests::FileSizeLimit> limit;
  std::uint16_t page = 0;
  std::string answer;
  const live::RunCallbacks calls{
      .open = [&](const std::string&) { return tests::live_session(folder); },
      .page =
          [&](const std::string&, std::uint16_t port) {
            page = port;
            limit.emplace(std::filesystem::file_size(file) + 10);
          },
      .status =
          [&] {
            return [&](const live::Status&, int) {
              if (answer.empty())
                answer = answer_to_control(page, "/api/weather", R"({"rain_rate_mm_per_h": 4})");
            };
          }};
  const std::vector<core::Problem> problems = problems_of_run(settings, calls);
  limit.reset();
  CHECK(answer.starts_with("HTTP/1.1 200"));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].code == "E-IO");
  CHECK(problems[0].place.file == file.string());
  CHECK(live::read_recording(file).events.empty());
}

TEST_CASE("A run ends with an error when the system refuses its recording as it is closed",
          "[live]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  const live::RunSettings settings{
      .rays_per_cell = 1.0, .lockstep = true, .record = file.string(), .frames = 2};
  const live::RunCallbacks calls{
      .open = [&](const std::string&) { return tests::live_session(folder); },
      .page = [](const std::string&, std::uint16_t) {},
      .status =
          [&] {
            return [&](const live::Status& now, int) {
              if (now.frames == 2) ::close(tests::open_descriptor(file));  // the last one
            };
          }};
  const std::vector<core::Problem> problems = problems_of_run(settings, calls);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].code == "E-IO");
  CHECK(problems[0].place.file == file.string());
  CHECK(live::read_recording(file).events.size() == 2);
}

// One was told, and the other when that was put right.
TEST_CASE("All sinks that cannot be are told at once, by their words and at their opening",
          "[live]") {
  const auto wrong_words = [](const std::vector<std::string>& sinks) {
    std::vector<std::string> values;
    try {
      live::wiring_of({.to = sinks}, nullptr);
    } catch (const core::InputError& error) {
      for (const core::Problem& problem : error.problems()) values.push_back(problem.value);
    }
    return values;
  };
  CHECK(wrong_words({"shm:../x", "bad", "shm:", "shm:fine"}) ==
        std::vector<std::string>{"\"../x\"", "\"bad\"", "\"\""});
  const tests::TemporaryFolder folder;
  const auto kept = folder.write("kept.raw", "kept");
  live::FramesTo to;
  for (const std::string& sink :
       {std::string("raw-bscope:/nonexistent/a"), "raw-bscope:" + kept.string(),
        std::string("raw-cscope:/nonexistent/b")})
    live::add_sink(sink, to);
  live::Sinks sinks(to, true);
  std::vector<std::string> files;
  try {
    sinks.begin(tests::live_session(folder)->scene()->description, 16.0);
  } catch (const core::InputError& error) {
    for (const core::Problem& problem : error.problems()) files.push_back(problem.place.file);
  }
  CHECK(files == std::vector<std::string>{"/nonexistent/a", "/nonexistent/b"});
  CHECK(std::filesystem::file_size(kept) == 4);
}

// Standard output is a file of another name there: each overwrote the other.
TEST_CASE("A recording into the file of raw pictures is refused, whatever names it goes by",
          "[live]") {
  const tests::TemporaryFolder folder;
  const auto film = folder.write("film.raw", "");
  const auto linked = folder.path() / "linked.raw";
  std::filesystem::create_hard_link(film, linked);
  const auto is_refused = [](const std::string& sink, const std::string& record) {
    try {
      live::wiring_of({.to = {"raw-bscope:" + sink}, .record = record}, nullptr);
    } catch (const core::InputError& error) {
      return error.problems().size() == 1 && error.problems()[0].field == "--record";
    }
    return false;
  };
  const int before = ::dup(STDOUT_FILENO);
  const int file = ::open(film.c_str(), O_WRONLY);
  REQUIRE((before >= 0 && file >= 0));
  ::dup2(file, STDOUT_FILENO);
  const bool by_descriptor = is_refused("-", "/dev/stdout"), by_name = is_refused("-", film);
  ::dup2(before, STDOUT_FILENO);
  ::close(before);
  ::close(file);
  CHECK(by_descriptor);
  CHECK(by_name);
  CHECK(is_refused(film, linked));
  CHECK(is_refused("none.raw", "./none.raw"));  // not there yet
  CHECK_FALSE(is_refused(film, folder.path() / "flight.jsonl"));
  CHECK_FALSE(is_refused("-", "-"));
  CHECK_FALSE(is_refused(film, ""));
}

// What was posted changed the replay.
TEST_CASE("The page of a run that flies a recording changes nothing of it", "[live]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write(
      "flight.jsonl",
      R"({"fanbeam_live":1,"scene":"test","from":["circle"],"rate_Hz":16,"lockstep":true})"
      "\n"
      R"({"control":"/api/weather","body":"{\"rain_rate_mm_per_h\": 4}"})"
      "\n"
      R"({"frame":1,"now_s":0.1,"at_s":0.1,"samples":1})"
      "\n");
  const live::Recording recording = live::read_recording(file);
  const live::RunSettings settings{.http = "0", .lockstep = true, .replay = file.string()};
  session::Session* flown = nullptr;
  std::uint16_t page = 0;
  std::string answer;
  const live::RunCallbacks calls{
      .open =
          [&](const std::string&) {
            auto session = tests::live_session(folder);
            flown = session.get();
            return session;
          },
      .page = [&](const std::string&, std::uint16_t port) { page = port; },
      .status =
          [&] {
            return [&](const live::Status&, int) {
              answer = answer_to_control(page, "/api/weather", R"({"rain_rate_mm_per_h": 50})");
              CHECK(flown->scene()->weather.rain_rate_mm_per_h == 4.0);
            };
          }};
  live::run_live(settings, live::wiring_of(settings, nullptr), &recording, "here", calls);
  CHECK(answer.starts_with("HTTP/1.1 409"));
}
