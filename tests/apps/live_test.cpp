// fanbeam live as a user starts and stops it.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "apps/live_status_line.h"
#include "core/files.h"
#include "tests/apps/child.h"
#include "tests/apps/program.h"
#include "tests/live/loopback.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;
using namespace fanbeam::tests;

TEST_CASE("live tells where to look and ends by itself when asked to", "[live]") {
  const Result result = run_fanbeam("live flat-grass --http 0 --seconds 1");
  INFO(result.output);
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("look at http://127.0.0.1:") != std::string::npos);
}

// The thread that heard the first packet found out, and the channel flew on without a pose.
TEST_CASE("Without the geoid's grid a source that needs it is refused, others are not", "[live]") {
  const TemporaryFolder folder;
  folder.write("scene.toml", replaced(kSmallScene, "vertical_datum = \"scene\"",
                                      "vertical_datum = \"ellipsoid\""));
  const auto live_from = [&](const std::string& source) {
    return run_fanbeam("live " + quoted(folder.path()) + " --http 0 --seconds 1 --from " + source,
                       "PROJ_DATA=/nonexistent");
  };
  const Result refused = live_from("native-fdm:0");
  INFO(refused.output);
  CHECK(refused.exit_code == 4);
  CHECK(refused.output.find("E-IO EGM96 geoid grid") != std::string::npos);
  for (const char* source : {"circle", "native-fdm:0,datum=ellipsoid"}) {
    const Result flown = live_from(source);
    INFO(flown.output);
    CHECK(flown.exit_code == 0);
  }
}

TEST_CASE("Shared memory that live made goes with it", "[live]") {
  const std::string name = "fanbeam_live_test_" + std::to_string(getpid());
  const Result result = run_fanbeam("live flat-grass --http 0 --seconds 1 --to shm:" + name);
  INFO(result.output);
  CHECK(result.exit_code == 0);
  CHECK_FALSE(std::filesystem::exists("/dev/shm/" + name));
}

TEST_CASE("SIGTERM and SIGINT are the good end of live, while it opens its scene and later",
          "[live]") {
  CHECK(run_fanbeam("help live").output.find("exit code 0") != std::string::npos);
  for (const int signal : {SIGTERM, SIGINT})
    for (const double after_ms : {0.0, 3000.0}) {
      INFO("signal " << signal << " after " << after_ms << " ms");
      Child child({"live", "braunschweig-26", "--http", "0", "-q"});
      child.wait_until_it_handles_signals();
      wait_ms(after_ms);
      child.send(signal);
      const int status = child.wait();
      CHECK(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == 0);
    }
}

namespace {

// On a busy machine; by themselves the cases below take ten seconds and more.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kLiveEnds_s = 8.0;
#else
constexpr double kLiveEnds_s = 3.0;
#endif

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Two frames, ten minutes of silence between them.
std::string silent_recording(const TemporaryFolder& folder) {
  return folder
      .write("silent.jsonl",
             R"({"fanbeam_live":1,"scene":"flat-grass","from":["native-fdm:0"],"rate_Hz":16,)"
             R"("lockstep":false})"
             "\n"
             R"({"frame":1,"now_s":0.1,"at_s":0.1,"samples":1})"
             "\n"
             R"({"frame":2,"now_s":600.1,"at_s":600.1,"samples":1})"
             "\n")
      .string();
}

}  // namespace

TEST_CASE("A signal ends live while it waits for a frame, or makes one that takes long", "[live]") {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> cases{{"--rate", "0.1"},
                                                    {"--replay", silent_recording(folder)},
                                                    {"--lockstep", "--rays-per-cell", "1000"}};
  for (const auto& options : cases) {
    INFO(options[0]);
    std::vector<std::string> words{"live", "flat-grass", "--http", "0", "-q"};
    words.insert(words.end(), options.begin(), options.end());
    Child child(words);
    child.wait_until_it_handles_signals();
    wait_ms(3000.0);
    REQUIRE(child.running());
    const auto begin = std::chrono::steady_clock::now();
    child.send(SIGINT);
    const int status = child.wait();
    CHECK(seconds_since(begin) < kLiveEnds_s);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
  }
}

TEST_CASE("The seconds of live end it between two frames too", "[live]") {
  const auto begin = std::chrono::steady_clock::now();
  const Result result = run_fanbeam("live flat-grass --http 0 --rate 0.1 --seconds 1");
  INFO(result.output);
  CHECK(result.exit_code == 0);
  CHECK(seconds_since(begin) < 8.0);  // the second frame is due after ten
}

TEST_CASE("A disk that is full ends live with an error", "[live]") {
  const Result full = run_fanbeam(
      "live flat-grass --http 0 --lockstep --rays-per-cell 1 --frames 2 --to raw-bscope:/dev/full");
  INFO(full.output);
  CHECK(full.exit_code == 4);
  CHECK(full.output.find("E-IO") != std::string::npos);
  CHECK(full.output.find("/dev/full") != std::string::npos);
}

TEST_CASE("All that is wrong with live's addresses is told before a scene is opened", "[live]") {
  const Result result = run_fanbeam("live no-such-scene --http 0.0.0.0:1 --from native-fdm:99999");
  CHECK(result.exit_code == 2);
  CHECK(result.output.find("E-UNSUPPORTED --http") != std::string::npos);
  CHECK(result.output.find("E-RANGE --from") != std::string::npos);
  CHECK(run_fanbeam("live --from car --to pipe:x").output.find("2 errors") != std::string::npos);
  CHECK(run_fanbeam("live --from ils flat-grass --http 0 --seconds 1").exit_code == 0);
}

TEST_CASE("Beyond this machine the page needs a token and a source its peers", "[live]") {
  const TemporaryFolder folder;
  for (const char* from :
       {"native-fdm:0.0.0.0:0", "circle,peer=127.0.0.1", "ils,datum=moon",
        "fg-generic:0,peer=somebody", ",datum=egm96", "circle,datum=egm96", "ils,datum=ellipsoid",
        "csv:", "circle,weather=simulator", "fg-generic:0,weather=mine"}) {
    INFO(from);
    const Result refused = run_fanbeam(std::string("live no-such-scene --from ") + from);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output.find("--from") != std::string::npos);
  }
  const auto token = folder.write("token", "short\n");
  CHECK(run_fanbeam("live flat-grass --token-file " + token.string()).output.find("5 characters") !=
        std::string::npos);
  folder.write("token", "0123456789abcdef\n");
  const Result open =
      run_fanbeam("live flat-grass --seconds 1 --http 0.0.0.0:0 --token-file " + token.string() +
                  " --from fg-generic:0.0.0.0:0,datum=ellipsoid,peer=127.0.0.1,peer=::1");
  INFO(open.output);
  CHECK(open.exit_code == 0);
  CHECK(open.output.find("0123456789abcdef") == std::string::npos);
}

TEST_CASE("Lockstep writes the same raw pictures every time, and a recording the same again",
          "[live]") {
  const TemporaryFolder folder;
  const auto bytes_of = [&](const std::string& options, const char* name) {
    const auto file = folder.path() / name;
    const Result result =
        run_fanbeam("live flat-grass --http 0 --to raw-bscope:" + file.string() + " " + options);
    INFO(result.output);
    CHECK(result.exit_code == 0);
    return core::read_file(file, 1 << 20);
  };
  const std::string record = (folder.path() / "flight.jsonl").string();
  const std::string first =
      bytes_of("--rays-per-cell 1 --lockstep --frames 3 --record " + record, "first");
  CHECK(first.size() == 3U * 164U * 524U);
  CHECK(bytes_of("--rays-per-cell 1 --lockstep --frames 3 --threads 1", "second") == first);
  CHECK(bytes_of("--lockstep --replay " + record, "again") == first);
  // It knows its sampling and rate.
  for (const char* option : {" --rays-per-cell 2", " --rate 8"})
    CHECK(run_fanbeam("live flat-grass --http 0 --replay " + record + option).exit_code == 2);
  // Watts are made again too.
  CHECK(run_fanbeam("live flat-grass --http 0 --lockstep --replay " + record +
                    " --to cat240:127.0.0.1:8600,bits=16")
            .exit_code == 0);
  // As fast as it was flown, some of the frames.
  CHECK(bytes_of("--speed 2 --replay " + record, "paced").size() % (164U * 524U) == 0);
}

// The display hid the noise, and it was left out of the watts too: cells in shadow had none.
TEST_CASE("Radar video in watts holds the receiver's noise, whatever the display shows", "[live]") {
  const int ear = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in at = tests::bound_to_loopback(ear);
  const TemporaryFolder folder;
  const auto record = folder.write(
      "flight.jsonl",
      R"({"fanbeam_live":1,"scene":"flat-grass","from":["circle"],"rate_Hz":16,"lockstep":true})"
      "\n"
      R"({"control":"/api/sensor","body":"{\"low_dB\":0,\"high_dB\":60}"})"
      "\n"
      R"({"frame":1,"now_s":0.1,"at_s":0.1,"samples":1})"
      "\n");
  const Result flown =
      run_fanbeam("live flat-grass --http 0 --lockstep --replay " + record.string() +
                  " --to cat240:127.0.0.1:" + std::to_string(ntohs(at.sin_port)) + ",bits=16");
  INFO(flown.output);
  REQUIRE(flown.exit_code == 0);
  // The summary, then the first column: two bytes a cell from byte 32 on, 0 for no power.
  std::vector<std::uint8_t> message(65536);
  REQUIRE(::recv(ear, message.data(), message.size(), MSG_DONTWAIT) > 0);
  REQUIRE(::recv(ear, message.data(), message.size(), MSG_DONTWAIT) > 32 + 2 * 524);
  ::close(ear);
  int dark = 0;
  for (std::size_t cell = 0; cell < 524; ++cell)
    dark += message[32 + 2 * cell] == 0 && message[33 + 2 * cell] == 0 ? 1 : 0;
  CHECK(dark == 0);  // 24 of them
}

TEST_CASE("A recording belongs to its scene, sensor and effects", "[live]") {
  const TemporaryFolder folder;
  const std::string record = (folder.path() / "flight.jsonl").string();
  CHECK(
      run_fanbeam("live flat-grass --http 0 --lockstep --frames 1 --record " + record).exit_code ==
      0);
  const Result other = run_fanbeam("live obstacle-field --http 0 --replay " + record);
  CHECK(other.exit_code == 3);
  CHECK(other.output.find("E-REF") != std::string::npos);
  for (const auto& [options, key] :
       {std::pair{" --effects none", "/effects"}, {" --sensor hivision-94", "/sensor"}}) {
    const Result changed =
        run_fanbeam("live flat-grass --http 0 --lockstep --replay " + record + options);
    INFO(changed.output);
    CHECK(changed.exit_code == 3);
    CHECK(changed.output.find(std::string("E-REF ") + key) != std::string::npos);
  }
  folder.write("wrong.jsonl", "{}\n");
  const Result wrong =
      run_fanbeam("live flat-grass --http 0 --replay " + (folder.path() / "wrong.jsonl").string());
  CHECK(wrong.exit_code == 3);
  CHECK(wrong.output.find("wrong.jsonl:1") != std::string::npos);
}

TEST_CASE(
    "A recording of several sources is flown in lockstep; what it says of them wrongly is its own",
    "[live]") {
  const TemporaryFolder folder;
  const auto replayed = [&](const std::string& from) {
    const auto record =
        folder.write("flight.jsonl", R"({"fanbeam_live":1,"scene":"flat-grass","from":)" + from +
                                         R"(,"rate_Hz":16,"lockstep":false})"
                                         "\n"
                                         R"({"frame":1,"now_s":0.1,"at_s":0.1,"samples":1})"
                                         "\n");
    return run_fanbeam("live flat-grass --http 0 --lockstep --replay " + record.string());
  };
  const Result two = replayed(R"(["native-fdm:0","fg-generic:0"])");
  INFO(two.output);
  CHECK(two.exit_code == 0);
  const Result wrong = replayed(R"("nonsense")");
  INFO(wrong.output);
  CHECK(wrong.exit_code == 3);
  CHECK(wrong.output.find("flight.jsonl:1: E-REF /from") != std::string::npos);
}

TEST_CASE("A trajectory of one's own flies in live", "[live]") {
  const TemporaryFolder folder;
  const std::string table = (folder.path() / "flight.csv").string();
  folder.write("flight.csv",
               "time_s,latitude_deg,longitude_deg,height_m\n0,52.0,10.0,100\n10,52.0,10.01,90\n");
  const Result result =
      run_fanbeam("live flat-grass --http 0 --lockstep --frames 2 --from csv:" + table);
  INFO(result.output);
  CHECK(result.exit_code == 0);
  CHECK(run_fanbeam("live flat-grass --http 0 --frames 1 --from csv:" + table + ".not").exit_code ==
        4);
}

TEST_CASE("What cannot be of sources and sinks is told all at once, before anything is written",
          "[live]") {
  const TemporaryFolder folder;
  folder.write("film.raw", "kept");
  const std::string film = (folder.path() / "film.raw").string();
  const Result result = run_fanbeam(
      "live flat-grass --http 0 --from xplane:127.0.0.1:49000,peer=127.0.0.1 --to raw-bscope:" +
      film +
      " --to cat240:127.0.0.1:0 --to cat240:127.0.0.1:8600,bits=9 "
      "--to cat240:127.0.0.1:8600,source=1/256 --to cat240:[::1]:8600,interface=127.0.0.1 "
      "--to cat240:127.0.0.1:8600,hops=-1 --to cat240:nowhere:8600 --to cat420:127.0.0.1:8600 "
      "--to cat240:127.0.0.1:8600,hops=2 --to cat240:127.0.0.1:8600,interface=127.0.0.1");
  CHECK(result.exit_code == 2);
  for (const char* told :
       {"no peer= of xplane", "a port from 1", "bits=8 or bits=16", "source=SAC/SIC",
        "interface= of IPv4", "hops=N", "127.0.0.1:8600,hops=2\"",
        "127.0.0.1:8600,interface=127.0.0.1\"", "with a multicast address", "an address in numbers",
        "\"cat420:127.0.0.1:8600\"", "10 errors"}) {
    INFO(told << "\n" << result.output);
    CHECK(result.output.find(told) != std::string::npos);
  }
  CHECK(fanbeam::core::read_file(film, 100) == "kept");
  CHECK(run_fanbeam("live flat-grass --http 0 --from xplane:0").exit_code == 2);
}

TEST_CASE("A page's port that somebody has leaves files as they are", "[live]") {
  const TemporaryFolder folder;
  folder.write("film.raw", "kept");
  const std::string film = (folder.path() / "film.raw").string();
  const std::string record = folder.write("flight.jsonl", "kept").string();
  const int other = ::socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in at = tests::bound_to_loopback(other);
  REQUIRE(::listen(other, 1) == 0);
  const Result taken = run_fanbeam("live flat-grass --http " + std::to_string(ntohs(at.sin_port)) +
                                   " --frames 1 --to raw-bscope:" + film + " --record " + record);
  CHECK(taken.exit_code == 4);
  CHECK(taken.output.find("a port that is free") != std::string::npos);
  // Nor does a sink that cannot be opened, or a source whose port is taken, beside them.
  for (const std::string& more :
       {std::string("--to raw-bscope:") + (folder.path() / "no/film.raw").string(),
        "--from native-fdm:" + std::to_string(ntohs(at.sin_port)),
        std::string("--to raw-cscope:").append(film)}) {
    INFO(more);
    const int datagrams = ::socket(AF_INET, SOCK_DGRAM, 0);
    REQUIRE(::bind(datagrams, reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0);
    const Result refused =
        run_fanbeam("live flat-grass --http 0 --frames 1 --to raw-bscope:" + film + " --record " +
                    record + " " + more);
    ::close(datagrams);
    INFO(refused.output);
    CHECK((refused.exit_code == 4 || refused.exit_code == 2));
    CHECK(fanbeam::core::read_file(film, 100) == "kept");
    CHECK(fanbeam::core::read_file(record, 100) == "kept");
  }
  ::close(other);
  CHECK(fanbeam::core::read_file(film, 100) == "kept");
  CHECK(fanbeam::core::read_file(record, 100) == "kept");
}

TEST_CASE("An option given twice is told as that", "[live]") {
  const Result twice = run_fanbeam("live flat-grass --http 0 --http 1");
  CHECK(twice.exit_code == 2);
  CHECK(twice.output.find("--http is given more than once") != std::string::npos);
}

TEST_CASE("Several simulators may send; what cannot stand beside another source is told",
          "[live]") {
  const auto refused = [](const std::string& options) {
    const Result result = run_fanbeam("live flat-grass --http 0 --seconds 1 " + options);
    INFO(options);
    CHECK(result.exit_code == 2);
    return result.output;
  };
  const std::string both = refused("--from ils --from circle");
  CHECK(both.find("\"ils\": expected no other source beside it") != std::string::npos);
  CHECK(both.find("\"circle\": expected no other source beside it") != std::string::npos);
  CHECK(refused("--from native-fdm:0,datum=egm96,datum=ellipsoid").find("each key once") !=
        std::string::npos);
  CHECK(refused("--to cat240:127.0.0.1:8600,bits=8,bits=16").find("each key once") !=
        std::string::npos);
  CHECK(refused("--to raw-bscope:- --to raw-cscope:-").find("another file or pipe") !=
        std::string::npos);
  CHECK(refused("--from native-fdm:0 --from cigi:0").find("no other source") != std::string::npos);
  CHECK(refused("--from native-fdm:0 --from fg-generic:0 --lockstep").find("several sources") !=
        std::string::npos);
  CHECK(refused("--from fg-generic:0,weather=simulator --from fg-generic:0,weather=simulator")
            .find("weather of one simulator") != std::string::npos);
  CHECK(
      refused("--from xplane:127.0.0.1:49000 --from xplane:127.0.0.1:49001").find("one X-Plane") !=
      std::string::npos);
  // The scene may stand behind an option that can be given several times.
  const Result fine = run_fanbeam(
      "live --http 0 --seconds 1 --from native-fdm:0 --from fg-generic:0 --from xplane:127.0.0.1:9 "
      "flat-grass");
  INFO(fine.output);
  CHECK(fine.exit_code == 0);
}

// Opening it waited, and swallowed the signal.
TEST_CASE("A pipe that nobody reads holds neither frames nor the end up", "[live]") {
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  Child child({"live", "flat-grass", "--http", "0", "-q", "--to", "raw-bscope:" + pipe});
  child.wait_until_it_handles_signals();
  wait_ms(2000.0);
  child.send(SIGTERM);
  const int status = child.wait();
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

// Each such line ended the flight, or stopped it for as long as nobody read.
TEST_CASE("What live tells waits for no reader and needs none", "[live]") {
  std::signal(SIGPIPE, SIG_IGN);  // as live does
  const std::string line(300, '\n');
  int full = -1, terminal = -1, pipe[2] = {-1, -1};
  REQUIRE((full = ::open("/dev/full", O_WRONLY)) >= 0);
  apps::tell_without_waiting(full, line);
  ::close(full);
  REQUIRE(::pipe(pipe) == 0);
  for (int i = 0; i < 300; ++i) apps::tell_without_waiting(pipe[1], line);  // it holds 64 KiB
  std::string heard(300, ' ');
  REQUIRE(::read(pipe[0], heard.data(), heard.size()) == 300);
  CHECK(heard == line);
  ::close(pipe[0]);
  apps::tell_without_waiting(pipe[1], line);
  ::close(pipe[1]);
  int keyboard = -1;
  REQUIRE(::openpty(&keyboard, &terminal, nullptr, nullptr, nullptr) == 0);
  for (int i = 0; i < 1000; ++i) apps::tell_without_waiting(terminal, line);
  // Whoever else has it goes on waiting for its own lines.
  CHECK((::fcntl(terminal, F_GETFL) & O_NONBLOCK) == 0);
  ::close(terminal);
  ::close(keyboard);
}

TEST_CASE("A datagram of no use that cannot be told does not end live", "[live]") {
  const int wire = ::socket(AF_INET, SOCK_DGRAM, 0);
  const int other = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in at = tests::bound_to_loopback(other);
  ::close(other);  // left to live
  std::atomic<bool> ended{false};
  std::thread sender([&] {
    for (; !ended; wait_ms(50.0))
      ::sendto(wire, "garbage", 7, MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&at), sizeof at);
  });
  const Result flown =
      run_shell("'" FANBEAM_BINARY_DIR
                "/bin/fanbeam' live flat-grass --http 0 --seconds 2 --from native-fdm:" +
                std::to_string(ntohs(at.sin_port)) + " 2>/dev/full </dev/null");
  ended = true;
  sender.join();
  ::close(wire);
  CHECK(flown.exit_code == 0);
}

TEST_CASE("A terminal that Ctrl-S holds holds neither frames nor the end up", "[live]") {
  const TemporaryFolder folder;
  const auto film = folder.path() / "film.raw";
  Child child({"live", "flat-grass", "--http", "0", "--to", "raw-bscope:" + film.string()}, true);
  const auto grows = [&] {
    std::error_code missing;
    const auto bytes = [&] {
      const auto size = std::filesystem::file_size(film, missing);
      return missing ? 0 : size;
    };
    const auto before = bytes();
    for (int i = 0; i < 200 && child.running(); ++i, wait_ms(50.0))
      if (bytes() > before) return true;
    return false;
  };
  REQUIRE(grows());
  child.hold_terminal();
  wait_ms(1500.0);  // three status lines
  CHECK(grows());
  const auto begin = std::chrono::steady_clock::now();
  child.send(SIGTERM);
  while (child.running() && seconds_since(begin) < kLiveEnds_s) wait_ms(20.0);
  REQUIRE_FALSE(child.running());  // or it would be waited for
  const int status = child.wait();
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}
