// A CIGI host made of bytes: what it sends becomes poses, weather and answers, and what goes wrong is
// told or counted.
#include "live/cigi_ig.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "core/units.h"
#include "terrain/geoid.h"
#include "tests/live/cigi_station.h"
#include "tests/processor_time.h"

using namespace fanbeam;
using namespace fanbeam::tests;
using namespace feeds::cigi;

TEST_CASE("A host's entity is the pose that it sent, in both byte orders", "[cigi]") {
  for (const bool swap : {false, true}) {
    Station station;
    station.hear(message(1, {entity(52.001, 10.002, 321.5, 256.0F, swap)}, kOperate, swap));
    REQUIRE(station.poses() == 1);
    const core::Pose pose = station.pose();
    CHECK(std::abs(pose.position.latitude_rad - core::radians(52.001)) < 1e-9);
    CHECK(std::abs(pose.position.longitude_rad - core::radians(10.002)) < 1e-9);
    CHECK(std::abs(pose.position.height_m - 321.5) < 1e-9);
    const core::Attitude attitude = core::attitude_from(pose.q_NB);
    CHECK(core::degrees(attitude.roll_rad) == Approx(3.0).epsilon(0.0).margin(1e-9));
    CHECK(core::degrees(attitude.pitch_rad) == Approx(-2.0).epsilon(0.0).margin(1e-9));
    CHECK(core::degrees(attitude.heading_rad) == Approx(256.0).epsilon(0.0).margin(1e-9));
  }
}

TEST_CASE("A view's entity and offset are where the radar sits", "[cigi]") {
  Station station;
  const Bytes view = Packet(16, 32, false)
                         .put<std::uint16_t>(2, 4)
                         .put<std::uint8_t>(5, 0x21)  // X and yaw
                         .put<std::uint16_t>(6, 7)
                         .put(8, 20.0F)
                         .put(12, 99.0F)  // not enabled
                         .put(28, 10.0F)
                         .bytes();
  Bytes level = entity(52.0, 10.0, 300.0, 0.0F, false, 7);
  for (const std::size_t at : {12U, 16U}) std::fill_n(level.begin() + std::ptrdiff_t(at), 4, 0);
  station.hear(message(1, {entity(51.0, 9.0, 100.0), level, view}));
  const auto frame = station.session->scene()->frame;
  const glm::dvec3 moved_m = frame.to_local_m(station.pose().position) -
                             frame.to_local_m({core::radians(52.0), core::radians(10.0), 300.0});
  CHECK(moved_m.x == Approx(0.0).epsilon(0.0).margin(1e-6));
  CHECK(moved_m.y == Approx(20.0).epsilon(0.0).margin(1e-6));
  CHECK(core::degrees(core::attitude_from(station.pose().q_NB).heading_rad) == Approx(10.0));
}

TEST_CASE("Velocity is told, or what places are apart", "[cigi]") {
  Station station;
  const double step_deg = 0.001;
  station.hear(message(1, {entity(52.0, 10.0, 300.0)}));
  station.hear(message(2, {entity(52.0 + step_deg, 10.0, 300.0)}));
  // 111.3 m of the meridian in 60 ms.
  CHECK(station.pose().v_N_mps.x == Approx(1854.4).epsilon(1e-3));
  const Bytes rate = Packet(8, 32, false).put<std::uint8_t>(5, 2).put(8, 70.0F).bytes();
  station.hear(message(3, {entity(52.0, 10.0, 300.0), rate}));
  const core::Pose pose = station.pose();
  CHECK(pose.v_N_mps.y == Approx(70.0 * std::cos(core::radians(2.0))));  // along the nose, east
  CHECK(pose.v_N_mps.z == Approx(70.0 * std::sin(core::radians(2.0))));
}

// The next Entity Control forgot it, one of the same message too.
TEST_CASE("A velocity that is told stays until another one or the end of its entity", "[cigi]") {
  Station station;
  std::uint32_t frame = 0;
  const auto velocity_after_mps = [&](const std::vector<Bytes>& packets) {
    station.hear(message(++frame, packets));
    return station.pose().v_N_mps;
  };
  const auto north_mps = [](float speed_mps) {
    return Packet(8, 32, false).put(8, speed_mps).bytes();
  };
  const auto at = [](int step, float heading_deg = 90.0F) {
    return entity(52.0 + 1e-5 * step, 10.0, 300.0, heading_deg);
  };
  // Places are 1.1 m apart, in 60 ms. Before the entity is known, without a packet, before and behind its place.
  CHECK(velocity_after_mps({north_mps(70.0F), at(0)}) == glm::dvec3(70.0, 0.0, 0.0));
  CHECK(velocity_after_mps({at(1)}) == glm::dvec3(70.0, 0.0, 0.0));
  CHECK(velocity_after_mps({north_mps(80.0F), at(2)}) == glm::dvec3(80.0, 0.0, 0.0));
  CHECK(velocity_after_mps({at(3), north_mps(0.0F)}) == glm::dvec3(0.0));
  CHECK(velocity_after_mps({at(4)}) == glm::dvec3(0.0));
  // Along the nose, which turns from east to south.
  const Bytes ahead = Packet(8, 32, false).put<std::uint8_t>(5, 2).put(8, 70.0F).bytes();
  CHECK(velocity_after_mps({at(5), ahead}).y == Approx(70.0 * std::cos(core::radians(2.0))));
  CHECK(velocity_after_mps({at(6, 180.0F)}).x == Approx(-70.0 * std::cos(core::radians(2.0))));
  // One that is removed is another one when it comes back, as all are behind a reset.
  Bytes removed = at(6);
  removed[4] = 2;
  for (const bool reset : {false, true}) {
    station.hear(reset ? message(++frame, {}, kStandby) : message(++frame, {removed}));
    CHECK(velocity_after_mps({at(7)}) == glm::dvec3(0.0));
    CHECK(velocity_after_mps({at(8)}).x == Approx(18.5).epsilon(0.01));
    CHECK(velocity_after_mps({at(8), ahead}).y > 69.0);
  }
}

TEST_CASE("Each frame begins with its number, the host's and the mode", "[cigi]") {
  Station station;
  station.hear(message(77, {}, kStandby));
  for (std::uint32_t frame = 1; frame < 4; ++frame) {
    const auto packets = packets_in(station.ig.begin_frame());
    CHECK(packets.size() == 1);
    CHECK(packets[0].second.at<std::uint16_t>(6) == 0x8000);
    CHECK(packets[0].second.at<std::uint32_t>(8) == frame);
    CHECK(packets[0].second.at<std::uint32_t>(16) == 77);
    CHECK(packets[0].second.bits(5, 0, 2) == 0);
    CHECK(packets[0].second.at<std::int8_t>(3) == 1);
  }
  station.hear(message(78, {entity(52.0, 10.0, 300.0)}, kStandby));
  CHECK(station.poses() == 0);  // standby: the picture stands
  station.hear(message(79, {entity(52.0, 10.0, 300.0)}, kOperate, false, 5));
  CHECK(station.poses() == 1);
  const auto told = packets_in(station.ig.begin_frame());
  CHECK(told[0].second.bits(5, 0, 2) == 1);
  CHECK(told[0].second.at<std::int8_t>(3) == -128);  // no such database
}

TEST_CASE(
    "A database that may be opened is told as its negative number, one that cannot be as -128",
    "[cigi]") {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::CigiStation before;
  before.others = {2, 3};
  before.ig_frame = 77;
  CigiIg ig(*session, core::VerticalDatum::scene, false, before);
  std::uint32_t number = 0;
  const auto told = [&](std::int8_t database) {
    ig.take(message(++number, {}, kOperate, false, database), "a:1");
    return packets_in(ig.begin_frame());
  };
  CHECK(told(1)[0].second.at<std::int8_t>(3) == 1);
  CHECK(told(2)[0].second.at<std::int8_t>(3) == -2);
  CHECK(ig.wanted_database() == 2);
  ig.refuse_database(2, "no such folder");
  CHECK(ig.wanted_database() == 1);
  const auto refused = told(2);
  CHECK(refused[0].second.at<std::int8_t>(3) == -128);
  REQUIRE(refused.size() == 2);
  CHECK(refused[1].first == 117);
  CHECK(told(0)[0].second.at<std::int8_t>(3) == 1);   // which is ours to choose
  CHECK(told(2)[0].second.at<std::int8_t>(3) == -2);  // tried again
  CHECK(ig.wanted_database() == 2);
  CHECK(told(-3)[0].second.at<std::int8_t>(3) == -128);
  // Whoever waits for us is told of the next frame without asking again.
  const live::CigiStation after = ig.station();
  CHECK(after.host == "a:1");
  CigiIg next(*session, core::VerticalDatum::scene, false, after);
  CHECK(next.host() == "a:1");
  const auto first = packets_in(next.begin_frame());
  CHECK(first[0].second.at<std::uint32_t>(8) == 77 + 6 + 1);
  CHECK(first[0].second.at<std::uint32_t>(16) == number);
  CHECK(first[0].second.bits(5, 0, 2) == 1);
}

TEST_CASE("F13 messages that come twice, late or from a second host are left out", "[cigi]") {
  Station station;
  const auto fly = [&](std::uint32_t frame, const char* host = "a:1") {
    station.hear(message(frame, {entity(52.0, 10.0, 300.0)}), host);
  };
  fly(10);
  fly(11);
  fly(11);
  fly(9);
  CHECK(station.poses() == 2);
  fly(12, "b:1");
  CHECK(station.poses() == 2);
  station.now += std::chrono::seconds(2);
  fly(1);  // the host began again
  CHECK(station.poses() == 3);
  station.now += std::chrono::seconds(6);
  fly(500, "b:1");
  CHECK(station.poses() == 4);
  fly(2, "a:1");
  CHECK(station.poses() == 4);
  const auto bad = station.told().bad_packets;
  CHECK(station.told().packets == 8);
  CHECK(all_of(bad) == 4);
}

// A second of good ones was late by its number.
TEST_CASE("F12 a message whose number is far from the last one's costs no other, a restart none",
          "[cigi]") {
  Station station;
  std::uint64_t sent = 0;
  const auto fly = [&](std::uint32_t frame) {
    station.hear(message(frame, {entity(52.0, 10.0, 300.0)}));
    ++sent;
  };
  const auto poses = [&] { return station.ig.mailbox().after(0).back().number; };
  for (std::uint32_t frame = 1; frame <= 20; ++frame) fly(frame);
  for (const std::uint32_t stray : {1'000'021U, 0x80000000U, 5'000U}) fly(stray);
  for (std::uint32_t frame = 21; frame <= 60; ++frame) {
    fly(frame);
    CHECK(poses() == sent - 3);
  }
  CHECK(station.told().bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                          {"a jump of the host's frame number", 3}});
  // Numbers that were lost, a host that goes on elsewhere, or begins again, at once: from its second message, both.
  for (const std::uint32_t frame : {100U, 7'000U, 7'001U, 7'002U, 1U, 2U, 4U}) fly(frame);
  CHECK(poses() == sent - 3);
  // What waits is all there: also its mode, and what it asks for.
  station.hear(message(9'000, {height_request(1, 52.0, 10.0, 120.0, 0)}));
  station.hear(message(9'001, {}));
  CHECK(packets_in(station.ig.begin_frame()).size() == 2);
  // After the largest number comes 0.
  station.now += std::chrono::seconds(2);
  const std::uint64_t before = poses();
  for (const std::uint32_t frame : {0xfffffffeU, 0xffffffffU, 0U, 1U}) fly(frame);
  CHECK(poses() == before + 4);
  CHECK(all_of(station.told().bad_packets) == 3);
}

// It counted as a fresh pose, at the old place.
TEST_CASE("F14 an entity whose place cannot be gives no pose and is counted by its reason",
          "[cigi]") {
  Station station;
  std::uint32_t frame = 0;
  const auto poses_after = [&](const std::vector<Bytes>& packets) {
    station.hear(message(++frame, packets));
    return station.ig.mailbox().after(0).back().number;
  };
  const Bytes good = entity(52.0, 10.0, 300.0);
  CHECK(poses_after({good}) == 1);
  CHECK(poses_after({entity(91.0, 10.0, 300.0)}) == 1);
  CHECK(poses_after({entity(52.0, 10.0, 1e9)}) == 1);
  CHECK(poses_after({entity(52.0, std::nan(""), 300.0)}) == 1);
  CHECK(poses_after({good}) == 2);
  // Another one's place is not the radar's.
  CHECK(poses_after({good, entity(91.0, 10.0, 300.0, 0.0F, false, 5)}) == 3);
  CHECK(poses_after({entity(52.0, std::nan(""), 300.0, 0.0F, false, 5), good}) == 4);
  // Nor does an entity that is not told stand anywhere else than it did.
  CHECK(poses_after({}) == 5);
  CHECK(core::degrees(station.pose().position.latitude_rad) == Approx(52.0));
  CHECK(station.told().bad_packets.empty());
  CHECK(station.told().unused_packets ==
        std::vector<std::pair<std::string, std::uint64_t>>{{"with a number that is not finite", 2},
                                                           {"with a position that cannot be", 3}});
}

// The geoid's grid ends at the pole: the thread that listens ended the program, the channel's the flight.
TEST_CASE("A place that rounding led beyond the pole is the pole, above the geoid too", "[cigi]") {
  const tests::TemporaryFolder folder;
  const auto session =
      tests::live_session(folder, tests::replaced(tests::kSmallScene, "vertical_datum = \"scene\"",
                                                  "vertical_datum = \"ellipsoid\""));
  CigiIg ig(*session, core::VerticalDatum::egm96);
  std::uint32_t frame = 0;
  for (const double latitude_deg : {90.0000005, -90.0000005}) {
    const auto place = [&](Packet packet, std::size_t at) {
      return packet.put(at, latitude_deg).put(at + 8, 10.0).put(at + 16, 300.0);
    };
    ig.take(message(++frame, {entity(latitude_deg, 10.0, 300.0),
                              height_request(1, latitude_deg, 10.0, 300.0),
                              place(place(Packet(25, 64, false), 8), 32).put(48, 400.0).bytes(),
                              place(Packet(26, 56, false).put(20, 100.0F), 24).bytes()}),
            "host");
    const auto letters = ig.mailbox().after(0);
    REQUIRE(letters.size() == frame);
    const core::Geodetic& at = letters.back().pose.position;
    CHECK(std::abs(at.latitude_rad) == core::kPi / 2);
    CHECK(at.height_m == 300.0 + terrain::egm96_geoid_height_m(at.latitude_rad, at.longitude_rad));
    // Each is answered.
    CHECK(packets_in(ig.begin_frame()).size() == 4);
  }
  live::Status status;
  ig.tell(status);
  CHECK(status.unused_packets.empty());
}

TEST_CASE("Weather and wet ground of a host come into force with the next frame", "[cigi]") {
  Station station;
  const Bytes wet = Packet(15, 8, false).put<std::uint16_t>(4, 1).put<std::uint8_t>(6, 1).bytes();
  station.hear(message(1, {weather(4, 0.0F, 0.0F, 3), weather(0, 250.0F, 0.0F), wet}));
  station.ig.begin_frame();
  auto scene = station.session->scene();
  CHECK(scene->weather.rain_rate_mm_per_h == 8.0);
  CHECK(scene->weather.visibility_m == 250.0);
  CHECK(scene->description.surface_state == materials::SurfaceState::wet);
  // Water of rain: 0.072 R^0.88 at 10 mm/h.
  station.hear(message(2, {weather(4, 0.0F, static_cast<float>(0.072 * std::pow(10.0, 0.88))),
                           weather(0, 250.0F, 0.2F)}));
  station.ig.begin_frame();
  scene = station.session->scene();
  CHECK(scene->weather.rain_rate_mm_per_h == Approx(10.0).epsilon(1e-6));
  CHECK(scene->weather.liquid_water_g_per_m3 == Approx(0.2));
  // What cannot be is told, and changes nothing.
  station.hear(message(3, {weather(0, 3.0F, 0.0F)}));
  const auto packets = packets_in(station.ig.begin_frame());
  REQUIRE(packets.size() == 2);
  CHECK(packets[1].first == 117);
  CHECK(station.session->scene()->weather.liquid_water_g_per_m3 == Approx(0.2));
  // Nor does it keep out what came with it; rain and snow that change places do so together.
  station.hear(message(31, {weather(0, 2.0F, 0.0F), weather(4, 0.0F, 0.0F, 1)}));
  CHECK(packets_in(station.ig.begin_frame()).size() == 2);
  CHECK(station.session->scene()->weather.rain_rate_mm_per_h == 1.0);
  station.hear(message(32, {weather(5, 0.0F, 0.0F, 2), weather(4, 0.0F, 0.0F, 0)}));
  CHECK(packets_in(station.ig.begin_frame()).size() == 1);
  CHECK(station.session->scene()->weather.snow_rate_mm_per_h == 1.0);
  CHECK(station.session->scene()->weather.rain_rate_mm_per_h == 0.0);
  // Standby and back: the scene's own weather and ground, which a host's dry ground is not.
  station.hear(message(40, {}, kStandby));
  station.hear(message(41, {}, kOperate));
  station.ig.begin_frame();
  scene = station.session->scene();
  CHECK(scene->weather.visibility_m == 400.0);
  CHECK(scene->weather.rain_rate_mm_per_h == 0.0);
  CHECK(scene->description.surface_state == materials::SurfaceState::dry);
}

TEST_CASE("Where a host says nothing of the ground it is the scene's", "[cigi]") {
  const tests::TemporaryFolder folder;
  const auto session =
      tests::live_session(folder, tests::replaced(tests::kSmallScene, "visibility_m = 400.0\n",
                                                  "visibility_m = 400.0\nsurface = \"wet\"\n"));
  CigiIg ig(*session, core::VerticalDatum::scene);
  const auto state = [&] {
    ig.begin_frame();
    return session->scene()->description.surface_state;
  };
  const auto ground = [](std::uint16_t condition, std::uint8_t enabled) {
    return Packet(15, 8, false).put(4, condition).put(6, enabled).bytes();
  };
  ig.take(message(1, {}), "host");
  CHECK(state() == materials::SurfaceState::wet);
  ig.take(message(2, {ground(2, 1)}), "host");
  CHECK(state() == materials::SurfaceState::dry_snow);
  ig.take(message(3, {ground(2, 0)}), "host");
  CHECK(state() == materials::SurfaceState::wet);
}

TEST_CASE("F11 of any bytes every good message is taken, and every other counted by its reason",
          "[cigi]") {
  Station station;
  std::mt19937 random(3);
  std::uint64_t good = 0, length = 0, version = 0, order = 0, size = 0, first = 0;
  // What one bit less or more makes of the head's bytes; the sixth is nobody's.
  const std::array<std::pair<std::size_t, std::uint64_t*>, 6> flips{
      {{0, &first}, {1, &size}, {2, &version}, {5, &good}, {6, &order}, {7, &order}}};
  for (int i = 0; i < tests::kRandomInputs; ++i) {
    Bytes bytes = message(static_cast<std::uint32_t>(i + 1), {entity(52.0, 10.0, 300.0)});
    constexpr std::size_t kHead_bytes = 24;
    switch (random() % 6) {
      case 0:
        bytes.resize(random() % kHead_bytes);
        ++length;
        break;
      case 1:  // within its second packet
        bytes.resize(kHead_bytes + 1 + random() % (bytes.size() - kHead_bytes - 1));
        ++size;
        break;
      case 2: {
        const auto& [at, count] = flips[random() % flips.size()];
        bytes[at] ^= static_cast<std::uint8_t>(1U << random() % 8);
        ++*count;
        break;
      }
      case 3:
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        bytes[0] |= 0x80;  // never IG Control
        ++first;
        break;
      default:
        ++good;
    }
    station.hear(bytes);
    if (i % 1000 == 0) station.ig.begin_frame();
  }
  const live::Status told = station.told();
  CHECK(told.packets == std::uint64_t{tests::kRandomInputs});
  CHECK(told.bad_packets == std::vector<std::pair<std::string, std::uint64_t>>{
                                {"another length", length},
                                {"another version", version},
                                {"no byte-swap word", order},
                                {"a packet of a size that cannot be", size},
                                {"another packet before IG Control", first}});
  CHECK(station.ig.mailbox().count() == good);
}
