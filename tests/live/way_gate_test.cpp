// Packets that come late of a source that tells no clock.
#include "live/way_gate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/units.h"
#include "live/feed.h"
#include "live/pose_source.h"
#include "tests/feeds/native_fdm_bytes.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;
using live::WayGate;

namespace {

constexpr double kBetween_s = 1.0 / 16.0;

// Of an aircraft in a level turn at 70 m/s.
std::vector<std::uint8_t> turning_bytes(const terrain::LocalFrame& frame, double time_s) {
  constexpr double kTurn_radps = 0.05, kTurn_mps = 70.0;
  const double radius_m = kTurn_mps / kTurn_radps, turned_rad = kTurn_radps * time_s;
  const core::Geodetic at = frame.to_geodetic(
      {radius_m * (1.0 - std::cos(turned_rad)), radius_m * std::sin(turned_rad), 300.0});
  const glm::dvec3 v_fps = kTurn_mps / core::kFoot_m *
                           glm::dvec3(std::sin(turned_rad), std::cos(turned_rad), 0.0) *
                           frame.north_east_down_at(at);
  auto bytes = tests::native_fdm_bytes(at.latitude_rad, at.longitude_rad);
  tests::put(bytes, 24, at.height_m);
  tests::put(bytes, 44, static_cast<float>(turned_rad));
  for (int i = 0; i < 3; ++i)
    tests::put(bytes, 76 + 4 * static_cast<std::size_t>(i), static_cast<float>(v_fps[i]));
  return bytes;
}

struct Flown {
  std::vector<glm::dvec3> places_m;  // at the middles of frames
  live::Status status;
};

// With one packet in ten overtaken by the next, or none.
Flown flown(const session::Session& session, bool overtaken) {
  const terrain::LocalFrame& frame = session.scene()->frame;
  const auto mailbox = std::make_shared<live::Mailbox>();
  live::Feed feed(session.scene(), core::VerticalDatum::egm96, feeds::kProtocols[0], mailbox);
  const auto begin = live::Clock::now();
  const live::PoseSource where = live::source_of(*mailbox, frame, begin);
  const auto send = [&](int i, double arrived_s) {
    feed.take(turning_bytes(frame, kBetween_s * i),
              begin + std::chrono::duration_cast<live::Clock::duration>(
                          std::chrono::duration<double>(arrived_s)));
  };
  Flown flown;
  for (int i = 0; i < 320; ++i) {
    const double now_s = kBetween_s * i;
    if (!overtaken || i % 10 != 8) send(i, now_s);
    if (overtaken && i % 10 == 9) send(i - 1, now_s + 1e-3);
    const auto seen = where(now_s + 2e-3, now_s + kBetween_s / 2);
    REQUIRE(seen);
    flown.places_m.push_back(frame.to_local_m(seen->pose.position));
  }
  feed.tell(flown.status);
  return flown;
}

struct KeptOut {
  int all = 0, in_a_row = 0;
};

KeptOut kept_out(const std::vector<WayGate::Packet>& packets) {
  WayGate gate;
  KeptOut kept;
  int row = 0;
  for (const WayGate::Packet& packet : packets) {
    row = gate.take(packet) ? 0 : row + 1;
    kept.all += row > 0 ? 1 : 0;
    kept.in_a_row = std::max(kept.in_a_row, row);
  }
  return kept;
}

using Motion = std::function<glm::dvec3(double time_s)>;

// For 20 s.
std::vector<WayGate::Packet> packets_of(const Motion& at_m, const Motion& v_mps,
                                        double between_s = kBetween_s) {
  std::vector<WayGate::Packet> packets;
  for (double time_s = 0.0; time_s < 20.0; time_s += between_s)
    packets.push_back({time_s, at_m(time_s), v_mps(time_s)});
  return packets;
}

glm::dvec3 ahead(double /*time_s*/) { return {0.0, 70.0, 0.0}; }

}  // namespace

// Each moved the aircraft back by a packet's way, and was counted nowhere.
TEST_CASE("F12 packets that others overtake move nothing without a clock too, and are counted",
          "[way_gate]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const Flown plain = flown(*session, false), mixed = flown(*session, true);
  CHECK(plain.status.bad_packets.empty());
  CHECK(mixed.status.packets == 320);
  CHECK(mixed.status.bad_packets ==
        std::vector<std::pair<std::string, std::uint64_t>>{{"late, or come twice", 32}});
  double worst_m = 0.0;
  for (std::size_t frame = 16; frame < plain.places_m.size(); ++frame)
    worst_m = std::max(worst_m, glm::distance(plain.places_m[frame], mixed.places_m[frame]));
  CHECK(worst_m < 0.1);
}

TEST_CASE("No aircraft that flies backwards, hovers, turns or stands loses a packet",
          "[way_gate]") {
  const auto back_and_forth = [](double speed_mps, double radps) {
    return packets_of(
        [=](double t) { return glm::dvec3(0.0, speed_mps / radps * std::sin(radps * t), 0.0); },
        [=](double t) { return glm::dvec3(0.0, speed_mps * std::cos(radps * t), 0.0); });
  };
  const auto circle = [](double radps, double between_s) {
    constexpr double kCircle_mps = 20.0;
    return packets_of(
        [=](double t) {
          return kCircle_mps / radps * glm::dvec3(std::cos(radps * t), std::sin(radps * t), 0.0);
        },
        [=](double t) {
          return kCircle_mps * glm::dvec3(-std::sin(radps * t), std::cos(radps * t), 0.0);
        },
        between_s);
  };
  CHECK(kept_out(back_and_forth(30.0, 1.0)).all == 0);
  CHECK(kept_out(back_and_forth(5.0, 2.5)).all == 0);
  for (const double radps : {0.5, 2.0, 4.0, 6.0, 9.0, 12.0})
    for (const double between_s : {0.25, kBetween_s})
      CHECK(kept_out(circle(radps, between_s)).all == 0);
  CHECK(kept_out(packets_of([](double t) { return glm::dvec3(0.0, -70.0 * t, 0.0); },
                            [](double) { return glm::dvec3(0.0, -70.0, 0.0); }))
            .all == 0);
  const auto stands = [](double t) { return glm::dvec3(0.0, 70.0 * std::min(t, 5.0), 0.0); };
  CHECK(kept_out(packets_of(stands, ahead)).all == 0);
}

TEST_CASE("F13 what is put back a little counts from its second packet, or its first",
          "[way_gate]") {
  for (const double back_m : {2.0, 6.0, 8.0, 50.0}) {
    INFO(back_m << " m back every two seconds");
    const KeptOut kept = kept_out(packets_of(
        [=](double t) { return glm::dvec3(0.0, 70.0 * t - back_m * std::floor(t / 2.0), 0.0); },
        ahead));
    CHECK(kept.in_a_row <= 1);
    CHECK(kept.all <= 9);
  }
  // A replay that is wound back, with the velocity that was.
  for (const double rate : {0.1, 0.5, 1.0, 2.0}) {
    INFO("wound back at " << rate);
    const auto wound = [=](double t) {
      return glm::dvec3(0.0, 70.0 * std::min(t, 5.0 - rate * (t - 5.0)), 0.0);
    };
    CHECK(kept_out(packets_of(wound, ahead)).all <= 1);
  }
}

TEST_CASE("Two packets that were held back and come at once behind a third are kept out",
          "[way_gate]") {
  auto packets = packets_of([](double t) { return glm::dvec3(0.0, 70.0 * t, 0.0); }, ahead);
  std::rotate(packets.begin() + 50, packets.begin() + 52, packets.begin() + 53);
  packets[51].arrived_s = packets[50].arrived_s + 1e-3;
  packets[52].arrived_s = packets[50].arrived_s + 2e-3;
  CHECK(kept_out(packets).all == 2);
}
