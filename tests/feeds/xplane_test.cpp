// X-Plane's datagrams, put together by the vendor's description: no X-Plane can run here.
#include "feeds/xplane.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <string>

#include "core/units.h"
#include "tests/feeds/xplane_bytes.h"

using namespace fanbeam;
using feeds::PacketFault;
using tests::xplane_position;

namespace {

PacketFault datagram_refusal(const std::vector<std::uint8_t>& datagram) {
  PacketFault fault{};
  CHECK_FALSE(feeds::decode_xplane(datagram, fault).has_value());
  return fault;
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

TEST_CASE("A position is degrees and metres, longitude first, with axes to east, up and south",
          "[xplane]") {
  PacketFault fault{};
  for (const char fifth : {'\0', '4', ','}) {  // versions differ in it
    const auto state = feeds::decode_xplane(xplane_position(52.3, 10.5, 300.0, fifth), fault);
    REQUIRE(state.has_value());
    CHECK(fault == PacketFault::none);
    CHECK(state->latitude_rad == core::radians(52.3));
    CHECK(state->longitude_rad == core::radians(10.5));
    CHECK(state->altitude_m == 300.0);
    CHECK(state->height_above_ground_m == 210.0);
    CHECK(state->attitude.pitch_rad == core::radians(-3.0));
    CHECK(state->attitude.heading_rad == core::radians(84.5));
    CHECK(state->attitude.roll_rad == core::radians(1.5));
    CHECK(state->v_N_mps == glm::dvec3(-7.0, 60.0, 4.0));  // of east 60, up -4, south 7
    CHECK_FALSE(state->visibility_m.has_value());
  }
}

TEST_CASE("What is no position is refused with its reason", "[xplane]") {
  auto datagram = xplane_position(52.3, 10.5, 300.0);
  datagram.push_back(0);
  CHECK(datagram_refusal(datagram) == PacketFault::length);
  datagram.resize(68);
  CHECK(datagram_refusal(datagram) == PacketFault::length);
  CHECK(datagram_refusal({}) == PacketFault::version);
  datagram = xplane_position(52.3, 10.5, 300.0);
  datagram[0] = 'X';
  CHECK(datagram_refusal(datagram) == PacketFault::version);
  CHECK(datagram_refusal(xplane_position(91.0, 10.5, 300.0)) == PacketFault::range);
  CHECK(datagram_refusal(xplane_position(std::numeric_limits<double>::quiet_NaN(), 10.5, 300.0)) ==
        PacketFault::nonfinite);
}

TEST_CASE("Values are pairs of index and number, finite or not", "[xplane]") {
  const float infinite = std::numeric_limits<float>::infinity();
  const auto values =
      feeds::decode_xplane_values(tests::xplane_values({{0, 800.0F}, {1, infinite}, {1, 0.5F}}));
  REQUIRE((values && values->size() == 3));
  CHECK((*values)[0] == std::pair(std::int32_t{0}, 800.0));
  CHECK((*values)[1] == std::pair(std::int32_t{1}, static_cast<double>(infinite)));
  CHECK((*values)[2] == std::pair(std::int32_t{1}, 0.5));
  auto cut = tests::xplane_values({{0, 800.0F}});
  cut.pop_back();
  CHECK_FALSE(feeds::decode_xplane_values(cut).has_value());
  CHECK_FALSE(feeds::decode_xplane_values(xplane_position(1.0, 1.0, 1.0)).has_value());
}

TEST_CASE("A beacon tells the port, and whether it is the simulator itself", "[xplane]") {
  const auto beacon = feeds::decode_xplane_beacon(tests::xplane_beacon(49000));
  REQUIRE(beacon.has_value());
  CHECK((beacon->is_simulator && beacon->port == 49000 && beacon->version == 120100));
  CHECK_FALSE(feeds::decode_xplane_beacon(tests::xplane_beacon(49000, 2))->is_simulator);
  auto other = tests::xplane_beacon(49000);
  other[5] = 2;  // a major version that nobody has described
  CHECK_FALSE(feeds::decode_xplane_beacon(other).has_value());
  other.resize(20);
  CHECK_FALSE(feeds::decode_xplane_beacon(other).has_value());
}

TEST_CASE("Requests are what the vendor describes, byte for byte", "[xplane]") {
  CHECK(text_of(feeds::xplane_position_request(16)) == std::string("RPOS\0"
                                                                   "16\0",
                                                                   8));
  const auto request = feeds::xplane_value_request(2, 258, "sim/weather/rain_percent");
  REQUIRE(request.size() == 413);
  CHECK(text_of(request).substr(0, 37) == std::string("RREF\0\x02\0\0\0\x02\x01\0\0"
                                                      "sim/weather/rain_percent",
                                                      37));
  CHECK(std::all_of(request.begin() + 37, request.end(),
                    [](std::uint8_t byte) { return byte == 0; }));
  // However long the name, a zero ends it.
  CHECK(feeds::xplane_value_request(1, 0, std::string(1000, 'x')).back() == 0);
}
