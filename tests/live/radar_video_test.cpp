// Radar video from frames to datagrams. What they say is read by TShark in tests/live/cat240_test.py.
#include "live/radar_video.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "core/errors.h"
#include "core/stop.h"
#include "core/units.h"
#include "tests/live/loopback.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;

namespace {

// A port of this machine that nobody else has.
class Ear {
 public:
  Ear() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    port = ntohs(tests::bound_to_loopback(socket_).sin_port);
    const timeval patience{2, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~Ear() { ::close(socket_); }
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  std::vector<std::uint8_t> hear() const {
    std::vector<std::uint8_t> bytes(65536);
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }

  std::uint16_t port = 0;

 private:
  int socket_;
};

sensors::Sensor small_sensor() {
  sensors::Sensor sensor = tests::hivision();
  sensor.scan.columns = 2;
  sensor.range.cells = 3;
  return sensor;
}

std::shared_ptr<live::LiveFrame> small_frame(std::uint64_t number) {
  auto frame = std::make_shared<live::LiveFrame>();
  frame->number = number;
  frame->bscope = {
      2, 3, {5, 6, 3, 4, 1, 2}};  // top row first: the left column is 1, 3, 5 from near to far
  frame->received_W = {0.0, 1e-12, 1e-25, 1e-13, 1e-30, 1e9};
  return frame;
}

live::RadarVideoSettings to(const Ear& ear) {
  live::RadarVideoSettings settings;
  settings.to.port = ear.port;
  return settings;
}

constexpr std::size_t kVideoAt = 32;

}  // namespace

TEST_CASE("A frame is a summary and its columns, left first, their cells from near to far",
          "[radar_video]") {
  const Ear ear;
  live::RadarVideo video(to(ear), small_sensor(), "test", 1000.0, true);
  const auto first = small_frame(1);
  video.write(first);
  video.write(first);  // given before
  video.write(small_frame(2));
  CHECK(ear.hear().at(7) == 1);
  for (std::uint8_t counter = 0; counter < 4; ++counter) {
    const auto message = ear.hear();
    REQUIRE(message.size() == kVideoAt + 4 + 3);
    CHECK(message[7] == 2);
    CHECK(message[11] == counter);
    const std::uint8_t left = counter % 2 == 0 ? 0 : 1;
    for (std::uint8_t cell = 0; cell < 3; ++cell)
      CHECK(message[kVideoAt + cell] == 1 + 2 * cell + left);
  }
}

TEST_CASE("Sixteen bits are dBW in steps of 0.005 dB, 0 for no power and the ends beyond the scale",
          "[radar_video]") {
  const Ear ear;
  live::RadarVideoSettings settings = to(ear);
  settings.bits = feeds::cat240::CellBits::sixteen;
  live::RadarVideo video(settings, small_sensor(), "test", 1000.0, true);
  video.write(small_frame(1));
  ear.hear();
  const auto levels = [&] {
    const auto message = ear.hear();
    REQUIRE(message.size() == kVideoAt + 8 + 3);
    std::vector<int> found;
    for (std::size_t at = kVideoAt; at < kVideoAt + 6; at += 2)
      found.push_back(256 * message[at] + message[at + 1]);
    return found;
  };
  CHECK(levels() == std::vector<int>{0, 1, 1});              // 0, -250 and -300 dBW
  CHECK(levels() == std::vector<int>{26001, 24001, 65535});  // -120, -130 and 90 dBW
}

TEST_CASE("F15 columns of a frame are spread over its period, and nobody waits for them",
          "[radar_video][threads]") {
  const Ear ear;
  constexpr double kRate_Hz = 5.0;
  const auto begin = live::Clock::now();
  {
    live::RadarVideo video(to(ear), small_sensor(), "test", kRate_Hz, false);
    video.write(small_frame(1));
    CHECK(live::seconds_between(begin, live::Clock::now()) < 0.5 / kRate_Hz);
    ear.hear();
    ear.hear();
    const auto first = live::Clock::now();
    ear.hear();
    // The second column is due 0.45 of the period after the first one.
    CHECK(live::seconds_between(first, live::Clock::now()) > 0.2 / kRate_Hz);
  }
}

TEST_CASE("The summary tells the levels of its frame", "[radar_video]") {
  const Ear ear;
  live::RadarVideo video(to(ear), small_sensor(), "test", 1000.0, true);
  const auto frame = small_frame(1);
  frame->low_dB = 7.5;
  frame->high_dB = -31.0;
  video.write(frame);
  const auto summary = ear.hear();
  const std::string text(summary.begin() + 9, summary.end() - 3);
  CHECK(text.find("8 bit 7.5 to -31 dB") != std::string::npos);
}

// A sweep takes 1.8 s, its 40 columns 45 ms each.
TEST_CASE("A channel that is told to stop ends in the middle of a sweep, any other with it",
          "[radar_video][threads]") {
  sensors::Sensor wide = small_sensor();
  wide.scan.columns = 40;
  const auto frame = small_frame(1);
  frame->bscope = {40, 3, std::vector<std::uint8_t>(120, 7)};
  for (const bool told : {true, false}) {
    INFO("told: " << told);
    const Ear ear;
    std::optional<live::RadarVideo> video;
    video.emplace(to(ear), wide, "test", 0.5, false);
    video->write(frame);
    REQUIRE(ear.hear().at(7) == 1);
    REQUIRE(ear.hear().at(7) == 2);  // the first column
    core::StopSource source;
    if (told) source.request();
    const core::StopToken token = source.token();
    const core::StopScope scope(token);
    const auto begin = live::Clock::now();
    video.reset();
    const double took_s = live::seconds_between(begin, live::Clock::now());
    CHECK((told ? took_s < 0.5 : took_s > 1.0));
  }
}

TEST_CASE("A place that cannot be sent to and cells beyond the category are refused",
          "[radar_video]") {
  const Ear ear;
  sensors::Sensor coarse = small_sensor();
  coarse.range.cell_m = 643.0;
  CHECK_THROWS_AS(live::RadarVideo(to(ear), coarse, "test", 16.0, true), core::InputError);
  live::RadarVideoSettings nowhere = to(ear);
  nowhere.to.address = "255.255.255.255";  // broadcast, which nobody asked the system for
  CHECK_THROWS_AS(live::RadarVideo(nowhere, small_sensor(), "test", 16.0, true), core::InputError);
}
