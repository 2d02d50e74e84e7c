// A recorded FlightGear flight over the scene that it flew over.
#include "live/feed.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <random>
#include <string>

#include "core/units.h"
#include "live/pose_source.h"
#include "live/predictor.h"
#include "live/wiring/listener.h"
#include "session/session.h"
#include "tests/feeds/native_fdm_bytes.h"
#include "tests/live/live_scene.h"
#include "tests/shared_data.h"

using namespace fanbeam;

TEST_CASE("A datum that is applied once too often shows in the heights above ground", "[feed]") {
  const auto recording = tests::shared_data("flightgear/bikf10.bin");
  if (!recording) return;
  core::ProblemList problems;
  const std::filesystem::path data = recording->parent_path().parent_path();
  scenes::SceneDescription description = scenes::read_scene(
      FANBEAM_SOURCE_DIR "/scenes/keflavik-10", {FANBEAM_SOURCE_DIR, {data}, {}}, problems);
  // Its terrain counts from the sea, as the simulator does: the scene takes heights as they are.
  const session::Session scene(description, {}, problems);
  live::Feed right(scene.scene(), core::VerticalDatum::egm96);
  description.datum = core::VerticalDatum::ellipsoid;  // which is not so
  const session::Session misled(description, {}, problems);
  live::Feed wrong(misled.scene(), core::VerticalDatum::egm96);
  std::ifstream stream(*recording, std::ios::binary);
  const auto begin = live::Clock::now();
  char head[12];
  while (stream.read(head, sizeof head)) {
    double arrived_s = 0.0;
    std::uint16_t length = 0;
    std::memcpy(&arrived_s, head, 8);
    std::memcpy(&length, head + 10, 2);
    std::vector<std::uint8_t> payload(length);
    stream.read(reinterpret_cast<char*>(payload.data()), length);
    const auto arrived =
        begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * arrived_s));
    right.take(payload, arrived);
    wrong.take(payload, arrived);
  }
  live::Status status;
  right.tell(status);
  CHECK(status.packets > 1800);
  CHECK(right.mailbox().after(0).back().number == status.packets);
  status.height_offset_m = right.height_offset_m();
  REQUIRE(status.height_offset_m.has_value());
  CHECK_FALSE(live::is_lasting_offset(status));
  status.height_offset_m = wrong.height_offset_m();
  CHECK(live::is_lasting_offset(status));
  // The geoid of EGM96 is 65.4 m above the ellipsoid there.
  CHECK(*status.height_offset_m == Approx(-65.4).epsilon(0.0).margin(3.0));
}

TEST_CASE("Heights above ground are compared over the scene's own ground, for five seconds",
          "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[1]);
  const auto begin = live::Clock::now();
  double now_s = 100.0;
  const auto fly = [&](double latitude_deg, double for_s, double step_s = 0.0625) {
    for (const double end_s = now_s + for_s; now_s < end_s; now_s += step_s) {
      const std::string line = "fanbeam,1," + std::to_string(now_s) + "," +
                               std::to_string(latitude_deg) + ",9.985,600,500,0,0,90,0,0,0,5000";
      feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
                begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * now_s)));
    }
  };
  const scenes::Scene& scene = *session->scene();
  const double ours_m = scene.world.surfaces().height_above_ground_m(
      scene.frame.to_local_m({core::radians(51.99), core::radians(9.985), 600.0 * core::kFoot_m}));
  fly(51.99, 4.9);
  CHECK_FALSE(feed.height_offset_m());
  fly(51.99, 0.4);
  REQUIRE(feed.height_offset_m());
  CHECK(*feed.height_offset_m() ==
        Approx(500.0 * core::kFoot_m - ours_m).epsilon(0.0).margin(0.01));
  // A hundred kilometres off, where the scene has none, and back: begun anew.
  fly(53.0, 6.0);
  CHECK_FALSE(feed.height_offset_m());
  fly(51.99, 4.9);
  CHECK_FALSE(feed.height_offset_m());
  // However many packets there are in a second.
  fly(51.99, 6.0, 0.5);
  CHECK(feed.height_offset_m());
  // After a restart too.
  const std::string again = "fanbeam,1,0,51.99,9.985,600,500,0,0,90,0,0,0,5000",
                    next = "fanbeam,1,0.06,51.99,9.985,600,500,0,0,90,0,0,0,5000";
  for (const std::string& line : {again, next})
    feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
              begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * now_s)));
  CHECK_FALSE(feed.height_offset_m());
}

TEST_CASE("Of several sources the one named first leads, another while it is silent", "[feed]") {
  live::Mailbox mailbox;
  const auto begin = live::Clock::now();
  const auto put = [&](double at_s, std::size_t source) {
    const std::uint64_t before = mailbox.after(0).empty() ? 0 : mailbox.after(0).back().number;
    mailbox.put({}, {},
                begin + std::chrono::duration_cast<live::Clock::duration>(
                            std::chrono::duration<double>(at_s)),
                {}, source);
    return !mailbox.after(before).empty();
  };
  CHECK_FALSE(mailbox.leading());
  CHECK(put(0.0, 1));
  CHECK_FALSE(put(0.1, 0));  // perhaps a stray one
  CHECK(put(0.15, 1));
  CHECK(put(0.2, 0));
  CHECK_FALSE(put(0.3, 1));
  CHECK_FALSE(put(0.69, 2));
  CHECK(mailbox.leading() == 0U);
  CHECK(put(0.71, 1));
  CHECK(mailbox.leading() == 1U);
  CHECK_FALSE(put(1.2, 2));
  CHECK(put(1.22, 2));
  CHECK_FALSE(put(1.3, 0));
  CHECK(put(1.4, 0));
  CHECK_FALSE(put(1.45, 2));
  CHECK(mailbox.leading() == 0U);
}

TEST_CASE("F13 single packets of a source that is silent else take no lead from another",
          "[feed]") {
  live::Mailbox mailbox;
  const auto begin = live::Clock::now();
  for (int i = 0; i < 80; ++i) {
    const auto now = begin + std::chrono::milliseconds(125 * i);
    if (i % 8 == 3) mailbox.put({}, {}, now - std::chrono::milliseconds(20), {}, 0);
    mailbox.put({}, {}, now, {}, 1);
    CHECK(mailbox.leading() == 1U);
  }
}

TEST_CASE("Packets of several sources are told together", "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto mailbox = std::make_shared<live::Mailbox>();
  live::Feed one(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[0], mailbox, 0);
  live::Feed other(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[0], mailbox, 1);
  const auto good = tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0));
  for (int i = 0; i < 10; ++i) {
    one.take(good);
    other.take(good);
  }
  one.take(std::vector<std::uint8_t>(3));
  other.take(std::vector<std::uint8_t>(3));
  live::Status status;
  one.tell(status);
  other.tell(status);
  CHECK(status.packets == 22);
  REQUIRE(status.bad_packets.size() == 1);
  CHECK(status.bad_packets[0].second == 2);
  CHECK(mailbox->after(0).back().number == 10);
}

TEST_CASE("F11 of a million datagrams every good one is taken and every other counted", "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96);
  const auto good = tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0));
  auto flipped = good, swapped = good;
  std::uint64_t state = 7;
  const auto next = [&state] {  // splitmix64
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  std::swap(swapped[0], swapped[3]);  // version 24 in the other byte order
  std::vector<std::uint8_t> noise(2001);
  std::uint64_t taken = 0, length = 0, version = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    switch (i % 8) {
      case 0:
        feed.take(good);
        ++taken;
        break;
      case 1:  // one bit of the version
        flipped = good;
        flipped[next() % 4] ^= static_cast<std::uint8_t>(1U << next() % 8);
        feed.take(flipped);
        ++version;
        break;
      case 2:
        feed.take(swapped);
        ++version;
        break;
      default: {
        const std::size_t size = next() % 2001;
        for (std::size_t k = 0; k < std::min<std::size_t>(size, 8); ++k)
          noise[k] = static_cast<std::uint8_t>(next() | 0x80);  // never the version
        feed.take(std::span(noise).first(size));
        ++(size == 408 ? version : length);
      }
    }
  }
  live::Status status;
  feed.tell(status);
  CHECK(status.packets == 1'000'000);
  CHECK(status.bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                  {"another length", length}, {"another version", version}});
  CHECK(feed.mailbox().after(0).back().number == taken);
}

TEST_CASE("F11 of a million lines every good one is taken and every other counted by its reason",
          "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[1]);
  const auto begin = live::Clock::now();
  std::mt19937 random(7);
  const std::string head = "fanbeam,2,", rest = ",52,10,600,500,0,0,90,0,200,0,5000,0.25,0.5\n";
  std::uint64_t good = 0, length = 0, version = 0, format = 0, nonfinite = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    std::string line = head + std::to_string(100.0 + 0.005 * i) + rest;
    const auto bit = [&] { return static_cast<char>(1U << random() % 8); };
    const std::size_t comma = line.find(',', head.size() + random() % (rest.size() - 12));
    switch (i % 8) {
      case 0:
        line[random() % head.size()] ^= bit();  // no bit makes it the first version's
        ++version;
        break;
      case 1:
        line[comma] ^= bit();
        ++format;
        break;
      case 2:
        line.resize(comma + 1);
        ++format;
        break;
      case 3:
        line.replace(comma + 1, line.find(',', comma + 1) - comma - 1,
                     random() % 2 ? "nan" : "1e400");
        ++nonfinite;
        break;
      case 4:
        std::reverse(line.begin(), line.end());
        ++version;
        break;
      case 5:
        line.resize(random() % 2001);
        for (char& letter : line) letter = static_cast<char>(random() | 0x80);
        ++(line.size() > 1024 ? length : version);
        break;
      default:
        ++good;
    }
    feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
              begin + std::chrono::milliseconds(5 * i));
  }
  live::Status status;
  feed.tell(status);
  CHECK(status.packets == 1'000'000);
  CHECK(status.bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                  {"another length", length},
                                  {"another version", version},
                                  {"not numbers between commas", format},
                                  {"a number that is not finite", nonfinite}});
  CHECK(feed.mailbox().count() == good);
}

TEST_CASE("F15 a source a hundred times too fast fills nothing, and the newest pose counts",
          "[feed]") {
  live::Mailbox mailbox;
  core::Pose pose;
  for (int i = 1; i <= 600'000; ++i) {  // ten minutes of a thousand a second
    pose.time_s = 1e-3 * i;
    mailbox.put(pose);
  }
  const auto kept = mailbox.after(0);
  CHECK(kept.size() == live::Mailbox::kKept);
  CHECK(kept.back().pose.time_s == 600.0);
  CHECK(mailbox.after(kept.back().number).empty());
}

TEST_CASE("Datagrams of no use are counted by reason and change no pose", "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96);
  const auto good = tests::native_fdm_bytes(core::radians(52.0), core::radians(10.0));
  feed.take(good);
  feed.take(std::span(good).first(100));
  feed.take({});
  auto other = good;
  tests::put(other, 0, 23, 4);
  feed.take(other);
  live::Status status;
  feed.tell(status);
  CHECK(status.packets == 4);
  CHECK(status.bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                  {"another length", 2}, {"another version", 1}});
  CHECK(feed.mailbox().after(0).size() == 1);
  // The scene does not know its datum: heights are taken as they are.
  CHECK(feed.mailbox().after(0)[0].pose.position.height_m == 200.0);
}

TEST_CASE("F12 a packet from another time, twice or late, is counted and costs no good one",
          "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[1]);
  const auto begin = live::Clock::now();
  const auto send = [&](const std::string& clock, double arrived_s) {
    const std::string line = "fanbeam,1," + clock + ",52,10,600,500,0,0,90,0,200,0,5000";
    feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
              begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * arrived_s)));
  };
  std::uint64_t good = 0;
  for (int i = 0; i < 1000; ++i) {
    const double clock_s = 100.0 + i / 16.0, arrived_s = i / 16.0;
    send(std::to_string(clock_s), arrived_s);
    ++good;
    switch (i % 10) {
      case 1:
        send("1e300", arrived_s + 0.005);
        break;
      case 3:
        send("nan", arrived_s + 0.005);
        break;
      case 5:
        send("inf", arrived_s + 0.005);
        break;
      case 7:
        send(std::to_string(clock_s), arrived_s + 0.005);  // twice
        break;
      case 9:
        send(std::to_string(clock_s - 0.03), arrived_s + 0.005);  // in the wrong order
        break;
      default:
        break;
    }
  }
  live::Status status;
  feed.tell(status);
  CHECK(feed.mailbox().after(0).back().number == good);
  CHECK(status.bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                  {"a number that is not finite", 200},
                                  {"late, or come twice", 200},
                                  {"a jump of the simulator's clock", 100}});
}

TEST_CASE("F13 a step of the simulator's clock counts from its second packet, a pause goes on",
          "[feed]") {
  live::ClockGate gate;
  using feeds::PacketFault;
  double arrived_s = 0.0;
  const auto take = [&](double clock_s) { return gate.take(clock_s, arrived_s += 0.0625); };
  CHECK(take(50.0) == PacketFault::none);
  CHECK(take(50.06) == PacketFault::none);
  CHECK(take(50.06) == PacketFault::none);  // paused
  CHECK(take(50.12) == PacketFault::none);
  for (const double step_s : {3600.0, -3600.0, 10.0, -50.0}) {  // and a restart at 0
    const double from_s = 50.12 + step_s;
    CHECK(take(from_s) == PacketFault::jump);
    CHECK(take(from_s + 0.06) == PacketFault::none);
    CHECK(take(50.12) == PacketFault::jump);
    CHECK(take(50.18) == PacketFault::none);
    CHECK(take(50.12) == PacketFault::late);
    CHECK(take(50.19) == PacketFault::none);
    // Back for the next one.
    CHECK(take(50.0) == PacketFault::late);
    CHECK(take(50.2) == PacketFault::none);
  }
}

// It locked good ones out for as long as it was ahead.
TEST_CASE("F12 a stray packet less than a second ahead costs two good ones at most", "[feed]") {
  using feeds::PacketFault;
  live::ClockGate gate;
  CHECK(gate.take(49.94, 9.94) == PacketFault::none);
  CHECK(gate.take(50.0, 10.0) == PacketFault::none);
  CHECK(gate.take(50.95, 10.01) == PacketFault::none);
  int lost = 0;
  for (int i = 1; i <= 30; ++i)
    lost += gate.take(50.0 + 0.06 * i, 10.0 + 0.06 * i) != PacketFault::none;
  CHECK(lost <= 2);
  CHECK_FALSE(gate.after_jump());
  // The clock put back by half a second.
  CHECK(gate.take(51.3, 11.86) == PacketFault::late);
  CHECK(gate.take(51.36, 11.92) == PacketFault::none);
  CHECK(gate.take(51.42, 11.98) == PacketFault::none);
  // Two that the network held back come at once, and put nothing back.
  CHECK(gate.take(51.6, 12.16) == PacketFault::none);
  CHECK(gate.take(51.48, 12.161) == PacketFault::late);
  CHECK(gate.take(51.54, 12.162) == PacketFault::late);
  CHECK(gate.take(51.66, 12.22) == PacketFault::none);
}

// Clock and place at once: each alone is settled on the second packet.
TEST_CASE("F13 a simulator that begins anew elsewhere is followed on its second packet", "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[1]);
  live::Predictor predictor(session->scene()->frame);
  const auto begin = live::Clock::now();
  std::uint64_t looked = 0;
  // The latitude that is flown after it.
  const auto send = [&](double clock_s, double latitude_deg, double arrived_s) {
    const std::string line = "fanbeam,1," + std::to_string(clock_s) + "," +
                             std::to_string(latitude_deg) + ",10,600,500,0,0,90,0,200,0,5000";
    feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()},
              begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * arrived_s)));
    for (const live::Mailbox::Letter& letter : feed.mailbox().after(looked)) {
      looked = letter.number;
      predictor.take(letter.pose, live::seconds_between(begin, letter.arrived), letter.clock_s);
    }
    return core::degrees(predictor.at(arrived_s)->position.latitude_rad);
  };
  for (int i = 0; i < 40; ++i) CHECK(send(100.0 + i / 16.0, 52.0, i / 16.0) == Approx(52.0));
  CHECK(send(0.0, 52.5, 2.5) == Approx(52.0).epsilon(0.0).margin(0.01));
  CHECK(send(0.0625, 52.5, 2.5625) == Approx(52.5).epsilon(0.0).margin(0.01));
  // Both count: none was of no use.
  live::Status status;
  feed.tell(status);
  CHECK(looked == 42);
  CHECK(status.bad_packets.empty());
}

// They were good packets, and of a flight that never was.
TEST_CASE(
    "F13 packets from a place that no aircraft reaches are counted and told, and move nothing",
    "[feed]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const std::vector<live::PosesFrom> from{live::poses_from("native-fdm:5501")};
  live::Listener listener(from, *session, 16.0, false, {});
  const auto mailbox = std::make_shared<live::Mailbox>();
  live::Feed feed(session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[0], mailbox);
  const auto begin = live::Clock::now();
  const auto where = live::source_of(*mailbox, session->scene()->frame, begin);
  live::Status status;
  for (int i = 0; i < 200; ++i) {
    const double now_s = i / 16.0, east_rad = core::radians(9.985 + 2.774e-5 * i);
    const bool stray = i % 10 == 9;
    feed.take(tests::native_fdm_bytes(core::radians(stray ? 53.0 : 51.99), east_rad),
              begin + std::chrono::microseconds(static_cast<std::int64_t>(1e6 * now_s)));
    const auto seen = where(now_s, now_s);
    REQUIRE(seen);
    CHECK(core::degrees(seen->pose.position.latitude_rad) ==
          Approx(51.99).epsilon(0.0).margin(1e-4));
    status.stray_poses = seen->strays;
  }
  CHECK(status.stray_poses == 19);  // whether the last one leads somewhere is not known yet
  // Nor do they begin the comparison of heights anew.
  CHECK(feed.height_offset_m());
  listener.tell(status);
  CHECK(status.bad_packets ==
        std::vector<std::pair<std::string, std::uint64_t>>{{"a step that no aircraft makes", 19}});
  // A CIGI host's too.
  const std::vector<live::PosesFrom> host{live::poses_from("cigi:8000")};
  live::Listener(host, *session, 16.0, false, {}).tell(status);
  CHECK(status.bad_packets.size() == 1);
}

TEST_CASE("A simulator that draws less than once a second is followed packet by packet", "[feed]") {
  for (const double step_s : {0.06, 0.9, 1.6, 5.0}) {
    live::ClockGate gate;
    int taken = 0;
    for (int i = 0; i < 20; ++i)
      taken += gate.take(100.0 + step_s * i, 7.0 + 0.98 * step_s * i) == feeds::PacketFault::none;
    INFO(step_s << " s between packets");
    CHECK(taken == 20);
    // But a clock that runs away from the time that passes waits for its second packet.
    CHECK(gate.take(100.0 + step_s * 20 + 900.0, 7.0 + 0.98 * step_s * 20) ==
          feeds::PacketFault::jump);
  }
}
