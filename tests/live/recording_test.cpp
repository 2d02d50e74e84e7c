// Live channels recorded and flown again: the same bytes, and recordings that are none.
#include "live/recording.h"

#include <sys/stat.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "core/files.h"
#include "core/units.h"
#include "live/channel.h"
#include "live/frame_maker.h"
#include "live/replay.h"
#include "tests/feeds/native_fdm_bytes.h"
#include "tests/live/file_size_limit.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;

namespace {

using Frames = std::vector<std::shared_ptr<const live::LiveFrame>>;

// Keeps every frame that a channel tells of.
live::Told keeping(Frames& frames, const live::Hub& hub, core::StopSource& stop,
                   std::size_t enough) {
  return [&, enough](live::Status&) {
    const auto newest = hub.newest();
    if (newest && (frames.empty() || frames.back()->number != newest->number))
      frames.push_back(newest);
    if (frames.size() >= enough) stop.request();
  };
}

void check_equal(const Frames& a, const Frames& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i]->number == b[i]->number);
    CHECK(a[i]->samples == b[i]->samples);
    CHECK(a[i]->bscope.pixels == b[i]->bscope.pixels);
    CHECK(a[i]->cscope.pixels == b[i]->cscope.pixels);
  }
}

// What a replay of the file gives, in lockstep, over a session opened anew.
Frames replayed(const std::filesystem::path& file, double own_samples = 1.0,
                const feeds::Protocol& protocol = feeds::kProtocols[0]) {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  session->set(session::Samples{own_samples});
  live::Hub hub;
  const live::Desk desk(*session, hub);
  const live::Recording recording = live::read_recording(file);
  const live::Feed feed(session->scene(), core::VerticalDatum::egm96, protocol);
  const live::Flight flight = live::circle(*session->scene());
  const bool flown = recording.flown_by.from == std::vector<std::string>{"circle"};
  Frames frames;
  core::StopSource stop;
  live::run_replay(*session, recording,
                   flown ? std::vector<const live::Feed*>{} : std::vector{&feed},
                   flown ? &flight : nullptr, desk, {.lockstep = true}, hub,
                   keeping(frames, hub, stop, 1'000'000), stop.token());
  return frames;
}

std::vector<core::Problem> problems_of(const std::filesystem::path& file) {
  try {
    live::read_recording(file);
  } catch (const core::InputError& error) {
    return error.problems();
  }
  return {};
}

// At 52.01 N 10 E, 200 m, standing.
std::vector<std::uint8_t> generic_line(double clock_s) {
  const std::string line =
      "fanbeam,1," + std::to_string(clock_s) + ",52.01,10,656.168,600,0,0,90,0,0,0,5000";
  return {line.begin(), line.end()};
}

constexpr const char* kHead =
    R"({"fanbeam_live":1,"scene":"s","from":"circle","rate_Hz":16,"lockstep":false})";

}  // namespace

TEST_CASE("A recorded flight with packets and controls gives the same bytes again", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  live::Hub hub;
  live::Journal journal(file, {scene->description.name, {"native-fdm:5501"}, 40.0, false});
  const live::Desk desk(*session, hub, &journal);
  live::Feed feed(scene, core::VerticalDatum::egm96);
  Frames frames;
  core::StopSource stop;
  std::atomic<bool> done{false};
  std::thread simulator([&] {
    for (int i = 0; !done; ++i) {
      feed.take(tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0 + 1e-5 * i)));
      if (i == 5)
        desk.answer({"POST",
                     "/api/weather",
                     "localhost",
                     {},
                     "application/json",
                     R"({"rain_rate_mm_per_h": 40})"});
      std::this_thread::sleep_for(std::chrono::milliseconds(13 + i % 3 * 8));
    }
  });
  const auto begin = live::Clock::now();
  live::run_channel(*session, live::source_of(feed.mailbox(), scene->frame, begin, &journal),
                    {40.0, 0.0, begin, &journal}, hub, keeping(frames, hub, stop, 30),
                    stop.token());
  done = true;
  simulator.join();
  REQUIRE(frames.size() == 30);
  CHECK(session->scene()->weather.rain_rate_mm_per_h == 40.0);
  CHECK(frames.front()->bscope.pixels != frames.back()->bscope.pixels);
  check_equal(replayed(file), frames);
}

TEST_CASE("Of two sources a recording keeps what counted, and gives the same bytes again",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "two.jsonl";
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  live::Hub hub;
  live::Journal journal(file, {"s", {"native-fdm:1", "fg-generic:2"}, 40.0, false});
  const auto mailbox = std::make_shared<live::Mailbox>();
  live::Feed first(scene, core::VerticalDatum::egm96, feeds::kProtocols[0], mailbox, 0);
  live::Feed second(scene, core::VerticalDatum::egm96, feeds::kProtocols[1], mailbox, 1);
  Frames frames;
  core::StopSource stop;
  std::atomic<bool> done{false};
  // The first falls silent; the second flies elsewhere all the time.
  std::thread simulators([&] {
    for (int i = 0; !done; ++i) {
      if (i < 10) first.take(tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0)));
      second.take(generic_line(0.02 * i));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  const auto begin = live::Clock::now();
  live::run_channel(*session, live::source_of(*mailbox, scene->frame, begin, &journal),
                    {40.0, 0.0, begin, &journal}, hub, keeping(frames, hub, stop, 60),
                    stop.token());
  done = true;
  simulators.join();
  REQUIRE(frames.size() == 60);
  const auto latitude_deg = [](const auto& frame) {
    return core::degrees(frame->pose.position.latitude_rad);
  };
  CHECK(latitude_deg(frames.front()) == Approx(52.0).epsilon(0.0).margin(1e-3));
  CHECK(latitude_deg(frames.back()) == Approx(52.01).epsilon(0.0).margin(1e-3));
  CHECK(mailbox->leading() == 1U);
  const live::Recording recording = live::read_recording(file);
  CHECK(recording.flown_by.from == std::vector<std::string>{"native-fdm:1", "fg-generic:2"});
  live::Hub again;
  const live::Desk desk(*session, again);
  Frames repeated;
  core::StopSource end;
  live::run_replay(*session, recording, {&first, &second}, nullptr, desk, {.lockstep = true}, again,
                   keeping(repeated, again, end, 1'000'000), end.token());
  check_equal(repeated, frames);
}

// The aircraft stood, as one that is there.
TEST_CASE("F13 a replay in time shows a picture as out of date where the channel did",
          "[recording][threads]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const live::Feed feed(session->scene(), core::VerticalDatum::egm96);
  live::Recording recording;
  recording.flown_by.from = {"native-fdm:1"};
  recording.flown_by.rate_Hz = 1.0;  // late is what comes a second late
  const auto frame = [&](std::uint64_t number, double now_s, double latitude_deg = 52.0) {
    // Of two packets, as one from elsewhere may be a stray one.
    for (const double before_s : {0.08, 0.05}) {
      const auto packet = tests::native_fdm_bytes(core::radians(latitude_deg), core::radians(10.0));
      recording.events.emplace_back(
          live::RecordedPacket{now_s - before_s, {packet.begin(), packet.end()}});
    }
    recording.events.emplace_back(live::RecordedFrame{{number, now_s, now_s}, 1.0});
  };
  frame(1, 0.1);
  frame(2, 0.3, 0.0);  // too far away: refused
  frame(3, 3.1);       // 2 was the first once more
  frame(4, 4.9);       // the one before took long
  frame(5, 6.0, 0.0);  // refused, and no other for a second: the one before once more
  frame(6, 6.2);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  Frames frames;
  core::StopSource stop;
  live::run_replay(*session, recording, {&feed}, nullptr, desk, {.speed = 2.0}, hub,
                   keeping(frames, hub, stop, 1'000'000), stop.token());
  REQUIRE(frames.size() == 6);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CHECK(frames[i]->number == i + 1);
    CHECK(frames[i]->stale == (i == 1 || i == 4));
  }
  CHECK(frames[1]->bscope.pixels == frames[0]->bscope.pixels);
  CHECK(frames[1]->pose_age_ms > 1000.0);
  CHECK(hub.status().frames == 4);
  CHECK(hub.status().refused == 2);
  CHECK_FALSE(hub.status().stale);
}

TEST_CASE("A packet of a source that a recording does not name is refused", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write(
      "wrong.jsonl",
      R"({"fanbeam_live":1,"scene":"s","from":["native-fdm:1","fg-generic:2"],"rate_Hz":16,"lockstep":false})"
      "\n"
      R"({"packet":"00","s":0.1,"from":1})"
      "\n"
      R"({"packet":"00","s":0.2,"from":2})"
      "\n");
  const auto problems = problems_of(file);
  REQUIRE(problems.size() == 1);
  CHECK(core::to_string(problems[0]).find(":3") != std::string::npos);
  CHECK(core::to_string(problems[0]).find("/from") != std::string::npos);
}

TEST_CASE("Lockstep gives a frame for every pose, whenever it comes, with the same bytes",
          "[recording][threads]") {
  const tests::TemporaryFolder folder;
  Frames runs[2];
  for (int run = 0; run < 2; ++run) {
    const auto session = tests::live_session(folder);
    const auto file = folder.path() / "lockstep.jsonl";
    live::Hub hub;
    live::Journal journal(file, {"s", {"native-fdm:1"}, 16.0, true});
    live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[0],
                    std::make_shared<live::Mailbox>(live::Mailbox::kKeptInLockstep));
    std::thread simulator([&] {
      for (int i = 0; i < 12; ++i) {
        feed.take(tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0 + 1e-4 * i)));
        if (run == 1) std::this_thread::sleep_for(std::chrono::milliseconds(7 * (i % 4)));
      }
    });
    core::StopSource stop;
    live::run_lockstep(*session, feed.mailbox(), {.samples = 1.0, .journal = &journal}, hub,
                       keeping(runs[run], hub, stop, 12), stop.token());
    simulator.join();
    CHECK(hub.status().late == 0);
    for (const auto& frame : runs[run])
      CHECK(core::degrees(frame->pose.position.longitude_rad) ==
            Approx(10.0 + 1e-4 * static_cast<double>(frame->number - 1)).epsilon(1e-7));
    // The scene's own time goes on: traffic stood still.
    for (const auto& frame : runs[run])
      CHECK(frame->pose.time_s == Approx(static_cast<double>(frame->number - 1) / 16.0));
    check_equal(replayed(file), runs[run]);
  }
  check_equal(runs[0], runs[1]);
}

// The first packet after the step waits for the second; then both are frames.
TEST_CASE("A restart in lockstep loses no frame, and its recording gives the same bytes",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto file = folder.path() / "restart.jsonl";
  live::Hub hub;
  live::Journal journal(file, {"s", {"fg-generic:1"}, 16.0, true});
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[1],
                  std::make_shared<live::Mailbox>(live::Mailbox::kKeptInLockstep));
  for (int i = 0; i < 12; ++i) {
    const double clock_s = i < 6 ? 100.0 + i / 16.0 : (i - 6) / 16.0;
    const std::string line = "fanbeam,1," + std::to_string(clock_s) + ",52," +
                             std::to_string(10.0 + 1e-4 * i) + ",600,500,0,0,90,0,200,0,5000";
    feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
  }
  Frames frames;
  core::StopSource stop;
  live::run_lockstep(*session, feed.mailbox(), {.samples = 1.0, .journal = &journal}, hub,
                     keeping(frames, hub, stop, 12), stop.token());
  REQUIRE(frames.size() == 12);
  for (const auto& frame : frames) {
    CHECK(core::degrees(frame->pose.position.longitude_rad) ==
          Approx(10.0 + 1e-4 * static_cast<double>(frame->number - 1)).epsilon(1e-7));
    CHECK(frame->pose.time_s == Approx(static_cast<double>(frame->number - 1) / 16.0));
  }
  check_equal(replayed(file, 1.0, feeds::kProtocols[1]), frames);
}

TEST_CASE("A flight in lockstep is at each tick, and the same when it is flown again",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto file = folder.path() / "circle.jsonl";
  live::Hub hub;
  live::Journal journal(file, {"s", {"circle"}, 16.0, true});
  Frames frames;
  core::StopSource stop;
  session->set(session::Samples{0.5});  // whatever the session has stays, and is no one's number
  live::run_lockstep(*session, live::circle(*session->scene()), {.journal = &journal}, hub,
                     keeping(frames, hub, stop, 4), stop.token());
  const live::Recording kept = live::read_recording(file);
  CHECK(std::get<live::RecordedFrame>(kept.events.at(0)).samples == 0.0);
  CHECK(frames.at(3)->pose.time_s == 3.5 / 16.0);
  check_equal(replayed(file, 0.5), frames);
}

TEST_CASE("A frame that the end left unmade is in no recording; what came meanwhile is",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto file = folder.path() / "ended.jsonl";
  live::Hub hub;
  live::Journal journal(file, {"s", {"circle"}, 16.0, true});
  live::FrameMaker maker(*session, hub, {.samples = 1.0, .journal = &journal});
  const core::Pose pose = live::circle(*session->scene())(0.0);
  core::StopSource stop;
  REQUIRE(maker.make({1, 0.0, 0.0}, {pose, 0.0}, stop.token()).has_value());
  stop.request();
  CHECK_FALSE(maker.make({2, 0.1, 0.1}, {pose, 0.0}, stop.token()).has_value());
  journal.frame({3, 0.2, 0.2}, 1.0);
  journal.packet(0.2, std::vector<std::uint8_t>{1, 2});
  CHECK(live::read_recording(file).events.size() == 1);  // as after a kill
  journal.made(false);
  const live::Recording recording = live::read_recording(file);
  REQUIRE(recording.events.size() == 2);
  CHECK(std::get<live::RecordedFrame>(recording.events[0]).tick.number == 1);
  CHECK(std::get<live::RecordedPacket>(recording.events[1]).bytes.size() == 2);
}

TEST_CASE("A recording is as it was until its channel begins, and one channel's alone",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("flight.jsonl", "kept");
  const live::FlownBy flown_by{"s", {"circle"}, 16.0, true};
  { const live::Journal given_up(file, flown_by); }
  CHECK(core::read_file(file, 100) == "kept");
  live::Journal journal(file, flown_by);
  CHECK_THROWS_AS(live::Journal(file, flown_by), core::InputError);
  journal.begin();
  journal.control("/api/weather", "{}");
  const live::Recording recording = live::read_recording(file);
  CHECK(recording.flown_by.scene == "s");
  CHECK(recording.events.size() == 1);
}

// The recording of a whole flight was refused for it.
TEST_CASE("A control on several lines is recorded and replayed as it came", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  const std::string body = "{\r\n\t\"rain_rate_mm_per_h\": 4\n}\n";
  const auto session = tests::live_session(folder);
  live::Hub hub;
  live::Journal journal(file, {"s", {"circle"}, 16.0, true});
  const live::Desk desk(*session, hub, &journal);
  REQUIRE(desk.answer({"POST", "/api/weather", "localhost", {}, "application/json", body}).status ==
          200);
  const live::Recording recording = live::read_recording(file);
  REQUIRE(recording.events.size() == 1);
  CHECK(std::get<live::RecordedControl>(recording.events[0]).body == body);
  CHECK(replayed(file).empty());
}

// It came in the middle of the flight, of a "body".
TEST_CASE("A recorded control that the scene refuses is told with its line", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("wrong.jsonl", std::string(kHead) +
                                                    R"(
{"control":"/api/weather","body":"{\"rain_rate_mm_per_h\": 4}"}
{"control":"/api/weather","body":"{\"rain_rate_mm_per_h\": 4000, \"snow_rate_mm_per_h\": -1}"}
)");
  std::vector<core::Problem> problems;
  try {
    replayed(file);
  } catch (const core::InputError& error) {
    problems = error.problems();
  }
  REQUIRE(problems.size() == 2);
  for (const core::Problem& problem : problems) {
    CHECK(problem.code == "E-RANGE");
    CHECK(problem.place.file == file.string());
    CHECK(problem.place.line == 3);
  }
}

TEST_CASE("A recording of another version is told as that alone", "[recording]") {
  const tests::TemporaryFolder folder;
  for (const auto& [version, code] : {std::pair("2", "E-RANGE"), {"\"1\"", "E-PARSE"}}) {
    std::string head = kHead;
    head.replace(head.find(":1,"), 2, ":" + std::string(version));
    const auto problems = problems_of(folder.write("later.jsonl", head + "\n"));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == code);
    CHECK(problems[0].field == "/fanbeam_live");
  }
}

// What a field that begins as an option's name tells is wrong with the command line.
TEST_CASE("What is no recording for its size or kind is the file's fault", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";  // opening it would never end
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const auto large = folder.write("large.jsonl", "");
  std::filesystem::resize_file(large, (2ULL << 30U) + 1);  // that occupy nothing
  for (const auto& [file, code] : {std::pair(pipe, "E-IO"), {large, "E-LIMIT"}}) {
    const auto problems = problems_of(file);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == code);
    CHECK(problems[0].place.file == file.string());
    CHECK_FALSE(problems[0].field.starts_with("--"));
  }
}

TEST_CASE("What is wrong with a recording is told with its line", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto wrong = [&](const std::string& text) {
    return problems_of(folder.write("wrong.jsonl", text));
  };
  CHECK(problems_of(folder.path() / "none.jsonl").at(0).code == "E-IO");
  CHECK(wrong("").at(0).code == "E-PARSE");
  CHECK(wrong("{\"fanbeam_live\":1}\n").size() == 4);
  const auto several =
      wrong(std::string(kHead) +
            "\n{\"packet\":\"0g\",\"s\":1}\n"
            "{\"frame\":0,\"now_s\":1,\"at_s\":1,\"samples\":1}\n"
            "{\"frame\":1,\"now_s\":1e999,\"at_s\":1,\"samples\":1}\nnonsense\n{}\n");
  CHECK(several.size() >= 6);
  CHECK(several.at(0).place.file.find(":2") != std::string::npos);
  CHECK(several.at(1).place.file.find(":3") != std::string::npos);
}

TEST_CASE("A file that is no recording is told once, not by each of its lines", "[recording]") {
  const tests::TemporaryFolder folder;
  std::string table = "airport,runway,length_m\n";
  for (int i = 0; i < 50; ++i) table += "EDVE,26," + std::to_string(i) + "\n";
  for (const std::string& text :
       {table, std::string("{}\n{}\n"), std::string("[1]\n2\n"), std::string("no line's end"),
        std::string(R"({"fanbeam_live":1,"scene":"s","fr)")}) {
    INFO(text.substr(0, 40));
    const auto problems = problems_of(folder.write("runways.csv", text));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].code == "E-REF");
    CHECK(problems[0].value == "no recording");
  }
}

TEST_CASE("A recording keeps its sensor and effects; an older one knows nothing of them",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  live::Journal(file, {"s", {"circle"}, 16.0, true, "HiVision", "none,+rain"}).begin();
  const live::FlownBy kept = live::read_recording(file).flown_by;
  CHECK(kept.sensor == std::optional<std::string>("HiVision"));
  CHECK(kept.effects == std::optional<std::string>("none,+rain"));
  const live::FlownBy older =
      live::read_recording(folder.write("older.jsonl", std::string(kHead) + "\n")).flown_by;
  CHECK_FALSE(older.sensor.has_value());
  CHECK_FALSE(older.effects.has_value());
}

// What was flown with a sensor of a frame in twenty seconds was lost.
TEST_CASE("A recording of any rate that a sensor may have is read", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  for (const double rate_Hz : {1e-3, 0.05, 1000.0}) {
    live::Journal(file, {"s", {"circle"}, rate_Hz, true}).begin();
    CHECK(live::read_recording(file).flown_by.rate_Hz == rate_Hz);
  }
}

TEST_CASE("The last line of a channel that was killed is left out", "[recording]") {
  const tests::TemporaryFolder folder;
  const live::Recording recording = live::read_recording(folder.write(
      "cut.jsonl", std::string(kHead) +
                       "\n{\"frame\":1,\"now_s\":1,\"at_s\":1,\"samples\":1}\n{\"frame\":2,\"no"));
  CHECK(recording.events.size() == 1);
}

// Half a line stayed, the next ones came behind it, and the recording was refused as a whole.
TEST_CASE("A control that finds no room leaves whole lines and ends recording and flight",
          "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  const auto session = tests::live_session(folder);
  live::Hub hub;
  live::Journal journal(file, {"s", {"native-fdm:1"}, 16.0, false});
  const live::Desk desk(*session, hub, &journal);
  const std::vector<std::uint8_t> packet{1, 2};
  journal.packet(0.1, packet);
  const auto whole_bytes = std::filesystem::file_size(file);
  int status = 0;
  {
    const tests::FileSizeLimit limit(whole_bytes + 10);
    status = desk.answer({"POST",
                          "/api/weather",
                          "localhost",
                          {},
                          "application/json",
                          R"({"rain_rate_mm_per_h": 4})"})
                 .status;
  }
  CHECK(status == 200);  // it is in force
  CHECK(session->scene()->weather.rain_rate_mm_per_h == 4.0);
  CHECK(std::filesystem::file_size(file) == whole_bytes);
  // There is room again, but nothing comes behind what is missing.
  CHECK_THROWS_AS(journal.throw_if_failed(), core::InputError);
  CHECK_THROWS_AS(journal.packet(0.2, packet), core::InputError);
  journal.frame({1, 0.2, 0.2}, 1.0);
  CHECK_THROWS_AS(journal.made(true), core::InputError);
  CHECK_THROWS_AS(journal.close(), core::InputError);
  CHECK(std::filesystem::file_size(file) == whole_bytes);
  CHECK(live::read_recording(file).events.size() == 1);
}

// It was in no picture that was shown.
TEST_CASE("A frame whose lines find no room for all of them is in no recording", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  live::Journal journal(file, {"s", {"circle"}, 16.0, false});
  journal.begin();
  const auto whole_bytes = std::filesystem::file_size(file);
  journal.frame({1, 0.1, 0.1}, 1.0);
  journal.control("/api/weather", std::string(1000, ' '));
  bool told = false;
  {
    const tests::FileSizeLimit limit(whole_bytes + 500);
    try {
      journal.made(true);
    } catch (const core::InputError& error) {
      told = error.has(core::ErrorClass::io);
    }
  }
  CHECK(told);
  CHECK(std::filesystem::file_size(file) == whole_bytes);
  CHECK(live::read_recording(file).events.empty());
}

TEST_CASE("What comes after a recording was closed is left out", "[recording]") {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "flight.jsonl";
  live::Journal journal(file, {"s", {"circle"}, 16.0, false});
  journal.begin();
  journal.close();
  journal.control("/api/weather", "{}");  // the page is there a little longer
  CHECK_NOTHROW(journal.throw_if_failed());
  CHECK(live::read_recording(file).events.empty());
}

// It was told to be empty; had it begun well, the rest would have been missing without a word.
TEST_CASE("A recording that the system cannot read on is no shorter one", "[recording]") {
  const auto problems = problems_of("/proc/self/mem");  // opens, and refuses its first byte
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].code == "E-IO");
}
