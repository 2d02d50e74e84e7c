// The talk with X-Plane, which a stand-in holds: requests, restarts, beacons, weather.
#include "live/xplane_link.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "live/simulator_weather.h"
#include "tests/feeds/xplane_bytes.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;
using live::Clock;

namespace {

const live::Endpoint kSimulator{"127.0.0.1", 49000};
const live::Sender kFromThere{"127.0.0.1", 49000, true};

struct Talk {
  explicit Talk(std::optional<live::Endpoint> simulator) : link(std::move(simulator), 16.0, feed) {}

  std::size_t requests_after(double seconds) {
    return link
        .requests(begin + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(seconds)))
        .size();
  }
  Clock::time_point at(double seconds) const {
    return begin +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  live::Status status() const {
    live::Status told;
    feed.tell(told);
    return told;
  }

  tests::TemporaryFolder folder;
  std::unique_ptr<session::Session> session = tests::live_session(folder);
  live::Feed feed{session->scene(), core::VerticalDatum::egm96, feeds::kProtocols[2]};
  Clock::time_point begin = Clock::now();
  live::XPlaneLink link;
};

}  // namespace

TEST_CASE(
    "Positions and weather are asked for each second until they come, and again when the "
    "simulator was started anew",
    "[xplane_link]") {
  Talk talk(kSimulator);
  CHECK(talk.requests_after(0.0) == 3);  // position, visibility, rain
  CHECK(talk.requests_after(0.5) == 0);
  CHECK(talk.requests_after(1.1) == 3);
  for (double t = 1.2; t < 5.0; t += 0.0625) {
    talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), kFromThere, talk.at(t));
    if (t < 1.3) talk.link.take(tests::xplane_values({{0, 700.0F}}), kFromThere, talk.at(t));
  }
  CHECK(talk.requests_after(5.1) == 0);
  // Its weather is silent, then all of it: it was started anew and has forgotten who asked.
  CHECK(talk.requests_after(5.5) == 3);
  CHECK(talk.requests_after(6.6) == 3);
  REQUIRE(talk.feed.newest().has_value());
  const auto letters = talk.link.farewell();
  REQUIRE(letters.size() == 3);
  CHECK(letters.front().datagram[5] == '0');
}

TEST_CASE("Weather that comes apart from positions reaches the radar's controls", "[xplane_link]") {
  Talk talk(kSimulator);
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), kFromThere);
  REQUIRE(talk.feed.newest().has_value());
  // Nothing is known yet: that is no fog.
  CHECK(live::weather_body(*talk.feed.newest()).find("visibility") == std::string::npos);
  talk.link.take(tests::xplane_values({{0, 700.0F}, {1, 0.5F}, {77, 1.0F}}), kFromThere);
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), kFromThere);
  CHECK(talk.feed.newest()->visibility_m == 700.0);
  CHECK(talk.feed.newest()->rain_norm == 0.5);
  CHECK(talk.status().packets == 2);
}

TEST_CASE("Weather of X-Plane that cannot be is counted, and what it told before stays",
          "[xplane_link]") {
  Talk talk(kSimulator);
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), kFromThere);
  talk.link.take(tests::xplane_values({{0, 700.0F}, {1, 0.5F}}), kFromThere);
  talk.link.take(tests::xplane_values({{0, std::nanf("")}, {0, 0.0F}, {1, -0.5F}, {1, 1.5F}}),
                 kFromThere);
  CHECK(talk.feed.newest()->visibility_m == 700.0);
  CHECK(talk.feed.newest()->rain_norm == 0.5);
  REQUIRE(talk.status().unused_packets.size() == 1);
  CHECK(talk.status().unused_packets[0].second == 4);
}

TEST_CASE("F12 packets of others than the simulator are counted and left alone", "[xplane_link]") {
  Talk talk(kSimulator);
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), {"127.0.0.2", 49000, true});
  CHECK_FALSE(talk.feed.newest().has_value());
  CHECK(talk.status().bad_packets.size() == 1);
}

TEST_CASE("What says nothing of the aircraft does not count as heard", "[xplane_link]") {
  Talk talk(kSimulator);
  CHECK(talk.requests_after(0.0) == 3);
  for (double t = 0.1; t < 1.2; t += 0.1) {
    talk.link.take(tests::xplane_values({{0, 700.0F}}), kFromThere, talk.at(t));
    talk.link.take(tests::xplane_beacon(49000), kFromThere, talk.at(t));
  }
  CHECK(talk.requests_after(1.2) == 3);
}

TEST_CASE("A beacon tells where to ask; another simulator's counts when the first is silent",
          "[xplane_link]") {
  Talk talk(std::nullopt);
  CHECK(talk.requests_after(0.0) == 0);  // nobody to ask
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), kFromThere, talk.at(0.0));
  CHECK_FALSE(talk.feed.newest().has_value());
  const live::Sender view{"10.0.0.9", 49707, true}, cockpit{"10.0.0.7", 49707, true},
      second{"10.0.0.8", 49707, true};
  talk.link.take_beacon(tests::xplane_beacon(49000, 2), view, talk.at(0.1));  // a view's machine
  CHECK(talk.requests_after(0.2) == 0);
  talk.link.take_beacon(tests::xplane_beacon(49010), cockpit, talk.at(0.3));
  const auto letters = talk.link.requests(talk.at(0.4));
  REQUIRE(letters.size() == 3);
  CHECK((letters.front().to.address == "10.0.0.7" && letters.front().to.port == 49010));
  talk.link.take(tests::xplane_position(52.3, 10.5, 300.0), {"10.0.0.7", 49010, true},
                 talk.at(1.0));
  talk.link.take_beacon(tests::xplane_beacon(49000), second, talk.at(2.0));
  CHECK(talk.link.requests(talk.at(2.5)).front().to.address == "10.0.0.7");
  talk.link.take_beacon(tests::xplane_beacon(49000), second, talk.at(6.1));
  CHECK(talk.link.requests(talk.at(6.2)).front().to.address == "10.0.0.8");
}

TEST_CASE("F11 of a million of X-Plane's datagrams every good one is taken and every other counted",
          "[xplane_link]") {
  Talk talk(kSimulator);
  std::uint32_t state = 7;
  const auto next = [&] { return (state = state * 1664525U + 1013904223U) >> 8U; };
  const tests::Bytes position = tests::xplane_position(52.3, 10.5, 300.0),
                     values = tests::xplane_values({{0, 700.0F}, {1, 0.5F}}),
                     beacon = tests::xplane_beacon(49000);
  std::uint64_t good = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    tests::Bytes bytes = i % 3 == 0 ? position : i % 3 == 1 ? values : beacon;
    if (i % 99 != 0) {
      bytes[next() % 4] ^= static_cast<std::uint8_t>(1 + next() % 255);  // another word
      bytes.resize(next() % (bytes.size() + 20));
    } else {
      ++good;
    }
    talk.link.take(bytes, kFromThere);
    talk.link.take_beacon(bytes, kFromThere);
  }
  const live::Status told = talk.status();
  CHECK(told.packets == 1'000'000);
  CHECK(told.bad_packets ==
        std::vector<std::pair<std::string, std::uint64_t>>{{"another version", 1'000'000 - good}});
  CHECK(talk.feed.mailbox().count() == good);
  CHECK(talk.feed.newest()->visibility_m == std::nullopt);
}
