// CIGI 3.3: packets put together by hand from the published offsets, in both byte orders, and messages
// that are none.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "core/units.h"
#include "feeds/bytes.h"
#include "feeds/cigi/host_packets.h"
#include "feeds/cigi/ig_packets.h"

using namespace fanbeam;
using namespace fanbeam::feeds::cigi;
using feeds::Fields;
using feeds::Packet;

namespace {

Bytes ig_control(bool swap) {
  return Packet(1, 24, swap)
      .put<std::uint8_t>(2, 3)
      .put<std::int8_t>(3, 7)
      .put<std::uint8_t>(4, 0x35)  // operate, timestamp valid, minor version 3
      .put<std::uint16_t>(6, 0x8000)
      .put<std::uint32_t>(8, 123456)
      .put<std::uint32_t>(12, 99)
      .bytes();
}

Bytes message_of(bool swap, const std::vector<Bytes>& packets) {
  Bytes message = ig_control(swap);
  for (const Bytes& packet : packets) message.insert(message.end(), packet.begin(), packet.end());
  return message;
}

HostMessage decoded(const Bytes& bytes) {
  MessageFault fault{};
  auto message = decode_host_message(bytes, fault);
  REQUIRE(message.has_value());
  return *message;
}

MessageFault fault_of(const Bytes& bytes) {
  MessageFault fault{};
  CHECK_FALSE(decode_host_message(bytes, fault).has_value());
  return fault;
}

Bytes entity(bool swap, double latitude_deg = 47.26) {
  return Packet(2, 48, swap)
      .put<std::uint16_t>(2, 5)
      .put<std::uint8_t>(4, 0x21)  // active, clamped
      .put<std::uint16_t>(8, 300)
      .put<std::uint16_t>(10, 9)
      .put(12, 1.5F)
      .put(16, -2.5F)
      .put(20, 256.0F)
      .put(24, latitude_deg)
      .put(32, 11.344)
      .put(40, 812.25)
      .bytes();
}

}  // namespace

TEST_CASE("The same message reads the same in both byte orders", "[cigi]") {
  for (const bool swap : {false, true}) {
    INFO("swapped " << swap);
    const HostMessage message = decoded(message_of(swap, {entity(swap)}));
    CHECK(message.control.database == 7);
    CHECK(message.control.mode == Mode::operate);
    CHECK(message.control.timestamp_valid);
    CHECK(message.control.minor_version == 3);
    CHECK(message.control.host_frame == 123456);
    CHECK(message.control.timestamp_10us == 99);
    REQUIRE(message.packets.size() == 1);
    const auto& own = std::get<EntityControl>(message.packets[0]);
    CHECK(own.entity == 5);
    CHECK(own.state == 1);
    CHECK_FALSE(own.attached);
    CHECK(core::degrees(own.attitude.roll_rad) == Approx(1.5));
    CHECK(core::degrees(own.attitude.pitch_rad) == Approx(-2.5));
    CHECK(core::degrees(own.attitude.heading_rad) == Approx(256.0));
    CHECK(own.place == glm::dvec3(core::radians(47.26), core::radians(11.344), 812.25));
  }
}

TEST_CASE("The first packet in network order is these bytes", "[cigi]") {
  const bool swap = std::endian::native == std::endian::little;
  const Bytes told =
      start_of_frame({-3, 0, Mode::operate, 3, 0x01020304, 0x0a0b0c0d, 0x11223344}, swap);
  CHECK(told == Bytes{101, 24, 3,  0xfd, 0,    0x35, 0x80, 0,    1, 2, 3, 4,
                      10,  11, 12, 13,   0x11, 0x22, 0x33, 0x44, 0, 0, 0, 0});
}

TEST_CASE("Controls of view, weather and ground are at their offsets", "[cigi]") {
  for (const bool swap : {false, true}) {
    const auto packet = [&](std::uint8_t id, std::uint8_t size) { return Packet(id, size, swap); };
    const HostMessage message = decoded(message_of(
        swap,
        {packet(16, 32)
             .put<std::uint8_t>(5, 0x3f)
             .put<std::uint16_t>(6, 5)
             .put(8, 4.0F)
             .put(12, 0.5F)
             .put(16, -1.0F)
             .put(24, -3.0F)
             .bytes(),
         packet(12, 56)
             .put<std::uint8_t>(4, 4)
             .put<std::uint8_t>(6, 1)
             .put<std::uint8_t>(7, 0x0d)
             .put(12, 800.0F)
             .put(24, 7.0F)
             .put(28, 900.0F)
             .put(52, 0.25F)
             .bytes(),
         packet(10, 32)
             .put<std::uint8_t>(2, 1)
             .put<std::uint8_t>(3, 80)
             .put(4, 12.0F)
             .put(24, 1001.0F)
             .bytes(),
         packet(15, 8).put<std::uint16_t>(4, 1).put<std::uint8_t>(6, 0x05).bytes(),
         packet(8, 32).put<std::uint16_t>(2, 5).put<std::uint8_t>(5, 2).put(8, 70.0F).bytes()}));
    REQUIRE(message.packets.size() == 5);
    const auto& view = std::get<ViewControl>(message.packets[0]);
    CHECK(view.entity == 5);
    CHECK(view.enables == 0x3f);
    CHECK(view.offset_m == glm::dvec3(4.0, 0.5, -1.0));
    CHECK(core::degrees(view.attitude.pitch_rad) == Approx(-3.0));
    const auto& rain = std::get<WeatherControl>(message.packets[1]);
    CHECK((rain.layer == 4 && rain.enabled && rain.scope == 1 && rain.severity == 3));
    CHECK((rain.visibility_m == 800.0 && rain.base_m == 7.0 && rain.thickness_m == 900.0));
    CHECK(rain.aerosol_g_per_m3 == 0.25);
    const auto& air = std::get<AtmosphereControl>(message.packets[2]);
    CHECK((air.enabled && air.humidity_percent == 80));
    CHECK((air.temperature_C == 12.0 && air.pressure_hPa == 1001.0));
    const auto& wet = std::get<SurfaceConditions>(message.packets[3]);
    CHECK((wet.enabled && wet.condition == 1 && wet.scope == 2));
    const auto& rate = std::get<RateControl>(message.packets[4]);
    CHECK((rate.entity == 5 && rate.body_axes && !rate.of_part && rate.v_mps.x == 70.0));
  }
}

TEST_CASE("Questions of height and sight are at their offsets", "[cigi]") {
  const HostMessage message = decoded(message_of(false, {Packet(24, 32, false)
                                                             .put<std::uint16_t>(2, 9)
                                                             .put<std::uint8_t>(4, 2)
                                                             .put<std::uint8_t>(5, 4)
                                                             .put(8, 47.0)
                                                             .put(16, 11.0)
                                                             .put(24, 900.0)
                                                             .bytes(),
                                                         Packet(25, 64, false)
                                                             .put<std::uint16_t>(2, 10)
                                                             .put<std::uint8_t>(4, 1)
                                                             .put<std::uint16_t>(6, 3)
                                                             .put(8, 47.0)
                                                             .put(16, 11.0)
                                                             .put(24, 900.0)
                                                             .put(32, 47.1)
                                                             .put(40, 11.1)
                                                             .put(48, 700.0)
                                                             .put<std::uint16_t>(62, 7)
                                                             .bytes(),
                                                         Packet(26, 56, false)
                                                             .put<std::uint16_t>(2, 11)
                                                             .put<std::uint8_t>(4, 3)
                                                             .put(8, 10.0F)
                                                             .put(12, -5.0F)
                                                             .put(16, 1.0F)
                                                             .put(20, 5000.0F)
                                                             .put(24, 2.0)
                                                             .put(32, 3.0)
                                                             .put(40, 4.0)
                                                             .bytes(),
                                                         Packet(25, 64, false)
                                                             .put<std::uint8_t>(4, 4 | 16)
                                                             .put<std::uint16_t>(6, 3)
                                                             .put<std::uint16_t>(62, 7)
                                                             .bytes()}));
  const auto& height = std::get<HeightRequest>(message.packets[0]);
  CHECK((height.request == 9 && height.kind == HeightKind::extended && height.update_period == 4));
  CHECK(height.place == glm::dvec3(core::radians(47.0), core::radians(11.0), 900.0));
  const auto& segment = std::get<SightRequest>(message.packets[1]);
  CHECK((segment.segment && segment.extended && segment.end.z == 700.0));
  CHECK((segment.entity == 3 && segment.end_entity == 3));  // 7 is not said to count
  const auto& to_other = std::get<SightRequest>(message.packets[3]);
  CHECK((to_other.to_entity && to_other.entity == 3 && to_other.end_entity == 7));
  const auto& vector = std::get<SightRequest>(message.packets[2]);
  CHECK((!vector.segment && vector.extended && vector.from_entity));
  CHECK(vector.source == glm::dvec3(2.0, 3.0, 4.0));  // an offset: no angles
  CHECK(core::degrees(vector.elevation_rad) == Approx(-5.0));
  CHECK(vector.most_m == 5000.0);
}

TEST_CASE("Packets that mean nothing are passed over by their size, and named", "[cigi]") {
  const HostMessage message =
      decoded(message_of(false, {Packet(14, 32, false).bytes(), Packet(201, 16, false).bytes(),
                                 entity(false), Packet(150, 8, false).bytes()}));
  CHECK(message.packets.size() == 1);
  CHECK(message.passed_over == std::vector<std::uint8_t>{14, 201, 150});
  CHECK(packet_name(14) == "wave_control");
  CHECK(packet_name(201) == "user_defined");
  CHECK(packet_name(150) == "unknown");
}

TEST_CASE("F14 a packet with a number that is none is left out, the others count", "[cigi]") {
  const HostMessage message = decoded(
      message_of(false, {entity(false, std::numeric_limits<double>::quiet_NaN()), entity(false),
                         entity(false, std::numeric_limits<double>::infinity())}));
  CHECK(message.packets.size() == 1);
  CHECK(message.nonfinite == 2);
  CHECK(message.unplaced.size() == 2);
}

TEST_CASE("F11 messages that are none are refused with their reason", "[cigi]") {
  CHECK(fault_of({}) == MessageFault::length);
  CHECK(fault_of(Bytes(23, 1)) == MessageFault::length);
  CHECK(fault_of(Bytes(70000, 1)) == MessageFault::length);
  Bytes message = message_of(false, {entity(false)});
  for (std::size_t size = 25; size < message.size(); ++size)
    CHECK(fault_of(Bytes(message.begin(), message.begin() + std::ptrdiff_t(size))) ==
          MessageFault::size);
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Bytes changed = message;
    changed[at] = value;
    return fault_of(changed);
  };
  CHECK(with(0, 2) == MessageFault::first);
  CHECK(with(1, 32) == MessageFault::size);
  CHECK(with(2, 4) == MessageFault::version);
  CHECK(with(6, 1) == MessageFault::order);
  CHECK(with(25, 0) == MessageFault::size);
  CHECK(with(25, 1) == MessageFault::size);
  CHECK(with(25, 40) == MessageFault::size);  // an entity of another size
}

TEST_CASE("Answers carry the frame of their question and the same values in both orders",
          "[cigi]") {
  for (const bool swap : {false, true}) {
    const Bytes height =
        height_response({9, true, HeightKind::extended, 120.5, 580.25, 12, 0.5, 1.25}, 0x35, swap);
    Fields f(height, swap);
    REQUIRE(height.size() == 40);
    CHECK((height[0] == 103 && height[1] == 40));
    CHECK(f.at<std::uint16_t>(2) == 9);
    CHECK(height[4] == 0x51);
    CHECK(f.at<double>(8) == 120.5);
    CHECK(f.at<double>(16) == 580.25);
    CHECK(f.at<std::uint32_t>(24) == 12);
    CHECK(f.at<float>(28) == Approx(core::degrees(0.5)));
    const Bytes basic = height_response({9, true, HeightKind::of, 580.25}, 2, swap);
    CHECK((basic.size() == 16 && basic[0] == 102 && basic[4] == 0x23));
    const Bytes sight =
        sight_response({4, true, true, true, 1234.5, {0.8, 0.2, 600.0}, 3}, 1, swap);
    CHECK((sight.size() == 56 && sight[0] == 105 && sight[4] == 0x1d && sight[5] == 1));
    CHECK(Fields(sight, swap).at<double>(8) == 1234.5);
    CHECK(Fields(sight, swap).at<double>(16) == Approx(core::degrees(0.8)));
  }
  const Bytes text = ig_message(3, "loading");
  CHECK(text.size() == 16);
  CHECK(std::memcmp(text.data() + 4, "loading", 8) == 0);
  CHECK(ig_message(3, std::string(500, 'x')).size() == 112);
}
