// What a CIGI host says of sensor, view, switches and time. TShark reads whole sessions (cigi_test.py).
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "core/files.h"
#include "core/units.h"
#include "live/channel.h"
#include "live/flights.h"
#include "tests/live/cigi_station.h"

using namespace fanbeam;
using namespace fanbeam::tests;
using namespace feeds::cigi;

namespace {

Bytes sensor_control(std::uint8_t flags, float gain, float level, float noise,
                     std::uint8_t response = 0) {
  return Packet(17, 24, false)
      .put<std::uint16_t>(2, 6)
      .put<std::uint8_t>(4, 2)
      .put(5, flags)
      .put(6, response)
      .put(8, gain)
      .put(12, level)
      .put(20, noise)
      .bytes();
}

Bytes component(std::uint16_t number, std::uint8_t state, float word = 0.0F, std::uint8_t of = 3) {
  return Packet(4, 32, false)
      .put(2, number)
      .put<std::uint16_t>(4, 40)
      .put(6, of)
      .put(7, state)
      .put(8, word)
      .bytes();
}

Bytes view_definition(std::uint8_t enables, float near_m, float far_m, float left_deg,
                      float right_deg, float top_deg, float bottom_deg) {
  return Packet(21, 32, false)
      .put<std::uint8_t>(5, enables)
      .put(8, near_m)
      .put(12, far_m)
      .put(16, left_deg)
      .put(20, right_deg)
      .put(24, top_deg)
      .put(28, bottom_deg)
      .bytes();
}

// Of one grey, 9, and one watt.
live::LiveFrame grey_frame(const std::shared_ptr<const scenes::Scene>& scene) {
  const sensors::Sensor& sensor = scene->description.sensor;
  const auto cells = static_cast<std::size_t>(sensor.scan.columns * sensor.range.cells);
  live::LiveFrame frame;
  frame.scene = scene;
  frame.bscope = {sensor.scan.columns, sensor.range.cells, std::vector<std::uint8_t>(cells, 9)};
  frame.cscope = {sensor.scan.columns, sensor.display.cscope_rows, {}};
  frame.cscope.pixels.assign(
      static_cast<std::size_t>(sensor.scan.columns * sensor.display.cscope_rows), 9);
  frame.received_W.assign(cells, 1.0);
  return frame;
}

template <class Cells>
std::ptrdiff_t lit(const Cells& cells) {
  return std::count_if(cells.begin(), cells.end(), [](auto cell) { return cell != 0; });
}

// What a host in lockstep sees that asks for something else with each frame: `together` sends all its messages
// before the first frame, else it waits for each frame.
std::vector<std::shared_ptr<const live::LiveFrame>> lockstep_frames(bool together) {
  const tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  const auto scene = session->scene();
  const auto at = [&](double time_s) {
    const core::Geodetic place = live::circle(*scene)(time_s).position;
    return entity(core::degrees(place.latitude_rad), core::degrees(place.longitude_rad),
                  place.height_m);
  };
  const std::vector<Bytes> messages{
      message(1, {at(0.0), weather(4, 0.0F, 0.0F, 5), component(1, 1, -6.0F)}),
      message(2, {sensor_control(0, 0.5F, 0.5F, 0.0F)}),  // at the place as it was
      message(3, {at(0.0), sensor_control(1, 0.9F, 0.5F, 0.0F), weather(4, 0.0F, 0.0F, 0)}),
      message(4, {}, kStandby),  // no pose, and a reset before the next frame
      message(5, {at(0.0)})};
  CigiIg ig(*session, core::VerticalDatum::scene, true);
  std::size_t heard = 0;
  const auto hear = [&] { ig.take(messages[heard++], "host"); };
  hear();
  while (together && heard < messages.size()) hear();
  live::Hub hub;
  core::StopSource stop;
  std::vector<std::shared_ptr<const live::LiveFrame>> frames;
  live::ChannelSettings settings{.samples = 1.0};
  settings.before_letter = [&](std::uint64_t number) { ig.begin_letter(number); };
  settings.dress = [&](live::LiveFrame& frame) { ig.dress(frame); };
  const auto told = [&](live::Status&) {
    if (const auto newest = hub.newest(); newest && newest->number > frames.size())
      frames.push_back(newest);
    ig.begin_frame();
    if (frames.size() == 4) stop.request();
    if (heard < messages.size()) hear();
  };
  live::run_lockstep(*session, ig.mailbox(), settings, hub, told, stop.token());
  return frames;
}

}  // namespace

// Conditions came into force with the frame after their message, or with any before it that waited.
TEST_CASE("In lockstep what a host asks for is of its own message's frame, however many wait",
          "[cigi]") {
  const auto one_by_one = lockstep_frames(false), together = lockstep_frames(true);
  REQUIRE(one_by_one.size() == 4);
  REQUIRE(together.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    INFO(i);
    CHECK(one_by_one[i]->bscope.pixels == together[i]->bscope.pixels);
    CHECK(one_by_one[i]->cscope.pixels == together[i]->cscope.pixels);
  }
  const auto conditions = [&](std::size_t i) { return together[i]->scene; };
  CHECK(conditions(0)->weather.rain_rate_mm_per_h == 50.0);
  CHECK(conditions(0)->description.sensor.antenna.boresight_elevation_rad == core::radians(-6.0));
  const auto is_black = [&](std::size_t i) {
    const auto& pixels = together[i]->bscope.pixels;
    return std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t grey) { return grey == 0; });
  };
  CHECK(!is_black(0));
  CHECK(is_black(1));
  CHECK(!is_black(2));
  CHECK(conditions(2)->weather.rain_rate_mm_per_h == 0.0);
  CHECK(conditions(2)->description.sensor.antenna.boresight_elevation_rad == core::radians(-6.0));
  CHECK(conditions(3)->description.sensor.antenna.boresight_elevation_rad != core::radians(-6.0));
}

TEST_CASE("Gain, level and noise of a host set the display's levels and the noise figure",
          "[cigi]") {
  Station station;
  const sensors::Sensor own = station.session->scene()->description.sensor;
  const double span_dB = own.display.high_dB - own.display.low_dB;
  const auto sensor_after = [&](const Bytes& packet, std::uint32_t frame) {
    station.hear(message(frame, {packet}));
    station.ig.begin_frame();
    return station.session->scene()->description.sensor;
  };
  // The middles are the sensor's own.
  sensors::Sensor now = sensor_after(sensor_control(1, 0.5F, 0.5F, 0.0F), 1);
  CHECK(now.display.low_dB == Approx(own.display.low_dB));
  CHECK(now.display.high_dB == Approx(own.display.high_dB));
  CHECK(now.receiver.noise_figure == own.receiver.noise_figure);
  // Full gain halves the span about its middle, full level moves it down by half of the own span, and
  // noise is 20 dB more.
  now = sensor_after(sensor_control(1, 1.0F, 1.0F, 1.0F), 2);
  CHECK(now.display.high_dB - now.display.low_dB == Approx(span_dB / 2));
  CHECK(now.display.high_dB + now.display.low_dB ==
        Approx(own.display.high_dB + own.display.low_dB - span_dB));
  CHECK(now.receiver.noise_figure == Approx(100.0 * own.receiver.noise_figure));
  // Standby forgets it.
  station.hear(message(3, {}, kStandby));
  station.ig.begin_frame();
  CHECK(station.session->scene()->description.sensor.display.low_dB == own.display.low_dB);
  // What is asked for and not there is counted: automatic gain, dropped lines.
  station.hear(message(4, {sensor_control(1 | 8, 0.5F, 0.5F, 0.0F)}));
  CHECK(all_of(station.told().unused_packets) == 1);
}

// It counted as the end of its range, without a word.
TEST_CASE(
    "What a host tells of sensor and weather beyond the protocol's range is counted and left out",
    "[cigi]") {
  Station station;
  const auto before = station.session->scene();
  std::uint32_t frame = 0;
  const auto counted_after = [&](const Bytes& packet) {
    station.hear(message(++frame, {packet}));
    station.ig.begin_frame();
    return all_of(station.told().unused_packets);
  };
  std::uint64_t counted = 0;
  for (const Bytes& packet :
       {sensor_control(1, 1.01F, 0.5F, 0.0F), sensor_control(0, -0.01F, 0.5F, 0.0F),
        sensor_control(1, 0.5F, 2.0F, 0.0F), sensor_control(1, 0.5F, 0.5F, 7.0F),
        tests::weather(4, 9000.0F, 0.0F, 6), tests::weather(5, 9000.0F, 0.0F, 7),
        tests::weather(0, 300.0F, -0.1F)})
    CHECK(counted_after(packet) == ++counted);
  const auto now = station.session->scene();
  CHECK(now->weather.rain_rate_mm_per_h == before->weather.rain_rate_mm_per_h);
  CHECK(now->weather.snow_rate_mm_per_h == before->weather.snow_rate_mm_per_h);
  CHECK(now->weather.visibility_m == before->weather.visibility_m);
  CHECK(now->description.sensor.display.low_dB == before->description.sensor.display.low_dB);
  CHECK(now->description.sensor.receiver.noise_figure ==
        before->description.sensor.receiver.noise_figure);
  CHECK(counted_after(tests::weather(4, 9000.0F, 0.0F, 5)) == counted);
  CHECK(station.session->scene()->weather.rain_rate_mm_per_h == 50.0);
}

// A display without levels to set, and a receiver that can have no more noise: what was refused was refused
// again with every switch that came later.
TEST_CASE("Switches work after a control that the sensor cannot follow", "[cigi]") {
  const tests::TemporaryFolder folder;
  const std::string file =
      core::read_file(std::string(FANBEAM_SOURCE_DIR) + "/sensors/hivision.toml", 1 << 20);
  folder.write("noisy.toml",
               tests::replaced(file, "noise_figure_dB = 6.0", "noise_figure_dB = 50.0"));
  for (const bool seed : {true, false}) {
    INFO(seed);
    const auto session =
        tests::live_session(folder, tests::kSmallScene + "\n[sensor]\nfile = \"" +
                                        (seed ? "hivision-seed.toml" : "noisy.toml") + "\"\n");
    CigiIg ig(*session, core::VerticalDatum::scene);
    const double own_noise_figure = session->scene()->description.sensor.receiver.noise_figure;
    const auto told = [&](std::uint32_t frame, const Bytes& packet) {
      ig.take(message(frame, {packet}), "host");
      return packets_in(ig.begin_frame());
    };
    // 20 dB more noise; of refused ones an IG Message tells.
    CHECK(told(1, sensor_control(1, 0.5F, 0.5F, 1.0F)).size() == (seed ? 1 : 2));
    const double noise_figure = session->scene()->description.sensor.receiver.noise_figure;
    CHECK(noise_figure == Approx(seed ? 100.0 * own_noise_figure : own_noise_figure));
    const auto event = told(2, component(1, 1, -2.0F));
    REQUIRE(event.size() == 2);
    CHECK(event[1].first == 116);
    CHECK(session->scene()->description.sensor.antenna.boresight_elevation_rad ==
          core::radians(-2.0));
    CHECK(told(3, sensor_control(1, 0.7F, 0.5F, 0.0F)).size() == 1);
    live::Status status;
    ig.tell(status);
    CHECK(all_of(status.unused_packets) == (seed ? 1 : 0));
  }
}

// All packets between two frames were refused with one of them, and a reset with what came behind it.
TEST_CASE("A switch that is refused keeps out nothing that came with it, nor a reset", "[cigi]") {
  const tests::TemporaryFolder folder;
  std::filesystem::copy_file(FANBEAM_SOURCE_DIR "/scenes/braunschweig-26/truck.gltf",
                             folder.path() / "truck.gltf");
  // Slices show its truck with a stabilised antenna alone.
  const auto session =
      tests::live_session(folder, tests::kSmallScene +
                                      "\n[[model]]\nfile = \"truck.gltf\"\nat = { runway = \"36\", "
                                      "behind_threshold_m = 300.0 }\ndefault_material = \"metal\"\n"
                                      "[accuracy]\ncaster = \"profile\"\n");
  CigiIg ig(*session, core::VerticalDatum::scene);
  const auto sensor = [&] { return session->scene()->description.sensor; };
  const sensors::Sensor own = sensor();
  const auto told = [&](const Bytes& bytes) {
    ig.take(bytes, "host");
    return packets_in(ig.begin_frame());
  };
  using CScopeMode = sensors::Display::CScopeMode;
  const auto packets = told(message(1, {component(1, 1, -2.0F), component(2, 0), component(3, 2),
                                        sensor_control(1, 0.7F, 0.5F, 0.0F)}));
  REQUIRE(packets.size() == 4);
  CHECK(packets[1].first == 117);
  CHECK(packets[2].second.at<std::uint16_t>(2) == 1);
  CHECK(packets[3].second.at<std::uint16_t>(2) == 3);
  CHECK(sensor().antenna.boresight_elevation_rad == core::radians(-2.0));
  CHECK(sensor().scan.stabilised);
  CHECK(sensor().display.cscope_mode == CScopeMode::shadow);
  CHECK(sensor().display.low_dB > own.display.low_dB);
  CHECK(told(message(2, {component(2, 0), component(3, 1)}, kStandby)).size() == 3);
  CHECK(sensor().antenna.boresight_elevation_rad == own.antenna.boresight_elevation_rad);
  CHECK(sensor().display.cscope_mode == CScopeMode::flat_earth);
  CHECK(sensor().display.low_dB == own.display.low_dB);
  // Nothing of it comes back later.
  CHECK(told(message(3, {component(2, 1)})).size() == 2);
  CHECK(sensor().antenna.boresight_elevation_rad == own.antenna.boresight_elevation_rad);
}

TEST_CASE("A sensor whose tracker is asked for searches, in every frame until it is off",
          "[cigi]") {
  Station station;
  station.hear(message(9, {sensor_control(1 | 2 << 5, 0.5F, 0.5F, 0.0F)}));
  for (int frame = 0; frame < 2; ++frame) {
    const auto packets = packets_in(station.ig.begin_frame());
    REQUIRE(packets.size() == 2);
    CHECK(packets[1].first == 106);
    CHECK(packets[1].second.at<std::uint16_t>(2) == 6);
    CHECK(packets[1].second.byte(4) == 2);
    CHECK(packets[1].second.byte(5) == 0);
    CHECK(packets[1].second.at<std::uint32_t>(20) == 9);
  }
  station.hear(message(10, {sensor_control(1 | 2 << 5, 0.5F, 0.5F, 0.0F, 1)}));
  CHECK(packets_in(station.ig.begin_frame())[1].first == 107);
  station.hear(message(11, {sensor_control(1, 0.5F, 0.5F, 0.0F)}));
  CHECK(packets_in(station.ig.begin_frame()).size() == 1);
}

TEST_CASE("Switches of the radar are told in an event once they are in force", "[cigi]") {
  Station station;
  station.hear(message(21, {component(1, 1, -4.5F), component(2, 0), component(3, 2),
                            component(1, 1, 91.0F), component(9, 1), component(1, 0, 0.0F, 0)}));
  const auto packets = packets_in(station.ig.begin_frame());
  const sensors::Sensor now = station.session->scene()->description.sensor;
  CHECK(now.antenna.boresight_elevation_rad == core::radians(-4.5));
  CHECK_FALSE(now.scan.stabilised);
  CHECK(now.display.cscope_mode == sensors::Display::CScopeMode::shadow);
  REQUIRE(packets.size() == 4);
  CHECK(packets[1].first == 116);
  CHECK(packets[1].second.at<std::uint16_t>(2) == 1);
  CHECK(packets[1].second.at<std::uint32_t>(4) == 40);
  CHECK(packets[1].second.at<std::uint32_t>(8) == 1);
  CHECK(packets[1].second.at<std::uint32_t>(12) == 21);
  CHECK(packets[3].second.at<std::uint16_t>(2) == 3);
  CHECK(all_of(station.told().unused_packets) == 3);
  CHECK(packets_in(station.ig.begin_frame()).size() == 1);  // told once
  const Bytes brief = Packet(5, 16, false).put<std::uint16_t>(2, 9).put<std::uint8_t>(6, 3).bytes();
  station.hear(message(22, {brief}));
  CHECK(station.told().unused_packets.back().first == "short_component_control (5)");
}

// Those beyond the sixteenth between two frames were in force, and not told.
TEST_CASE("However many switches come between two frames the state in force is told of each",
          "[cigi]") {
  Station station;
  for (std::uint32_t frame = 1; frame <= 20; ++frame) {
    const bool odd = frame % 2 == 1;
    station.hear(message(frame, {component(1, 1, -0.1F * static_cast<float>(frame)),
                                 component(2, odd ? 1 : 0), component(3, odd ? 1 : 2)}));
  }
  const auto packets = packets_in(station.ig.begin_frame());
  const sensors::Sensor now = station.session->scene()->description.sensor;
  CHECK(core::degrees(now.antenna.boresight_elevation_rad) == Approx(-2.0));
  CHECK_FALSE(now.scan.stabilised);
  CHECK(now.display.cscope_mode == sensors::Display::CScopeMode::shadow);
  REQUIRE(packets.size() == 4);
  const std::array<std::uint32_t, 3> states{1, 0, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(packets[i + 1].first == 116);
    CHECK(packets[i + 1].second.at<std::uint16_t>(2) == i + 1);
    CHECK(packets[i + 1].second.at<std::uint32_t>(8) == states.at(i));
    CHECK(packets[i + 1].second.at<std::uint32_t>(12) == 20);
  }
}

TEST_CASE("A view's near, far and sides blank what lies beyond them", "[cigi]") {
  Station station;
  sensors::Sensor sensor = station.session->scene()->description.sensor;
  const auto frame_now = [&] {
    station.ig.begin_frame();
    live::LiveFrame frame = grey_frame(station.session->scene());
    station.ig.dress(frame);
    return frame;
  };
  CHECK(lit(frame_now().bscope.pixels) == sensor.scan.columns * sensor.range.cells);
  // Ten range cells, from the fifth on.
  const auto near_m = static_cast<float>(sensor.range.minimum_m + 4.0 * sensor.range.cell_m),
             far_m = static_cast<float>(sensor.range.minimum_m + 14.0 * sensor.range.cell_m);
  station.hear(message(1, {view_definition(1 | 2, near_m, far_m, 1.0F, 1.0F, -1.0F, 1.0F)}));
  live::LiveFrame frame = frame_now();
  CHECK(lit(frame.bscope.pixels) == 10 * sensor.scan.columns);
  CHECK(lit(frame.received_W) == 10 * sensor.scan.columns);
  CHECK(lit(frame.cscope.pixels) == sensor.scan.columns * sensor.display.cscope_rows);
  // Near cells are at the picture's foot, and first in watts.
  CHECK(frame.bscope.pixels[static_cast<std::size_t>(sensor.range.cells - 5) *
                            static_cast<std::size_t>(sensor.scan.columns)] == 9);
  CHECK(frame.received_W[static_cast<std::size_t>(4 * sensor.scan.columns)] == 1.0);
  // The right half, and what is above the middle of the C-scope.
  const auto middle_deg = static_cast<float>(
      core::degrees(sensor.display.cscope_top_rad - sensor.display.cscope_span_rad / 2));
  station.hear(message(2, {view_definition(4 | 32, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, middle_deg)}));
  frame = frame_now();
  CHECK(lit(frame.bscope.pixels) == sensor.scan.columns / 2 * sensor.range.cells);
  CHECK(frame.bscope.pixels.back() == 9);
  CHECK(frame.bscope.pixels.front() == 0);
  CHECK(lit(frame.cscope.pixels) == sensor.scan.columns / 2 * (sensor.display.cscope_rows / 2));
  CHECK(frame.cscope.pixels.back() == 0);
  // Black-hot, then off.
  station.hear(message(3, {view_definition(0, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F),
                           sensor_control(1 | 2, 0.5F, 0.5F, 0.0F)}));
  CHECK(frame_now().bscope.pixels.front() == 246);
  station.hear(message(4, {sensor_control(0, 0.5F, 0.5F, 0.0F)}));
  frame = frame_now();
  CHECK(lit(frame.bscope.pixels) + lit(frame.cscope.pixels) + lit(frame.received_W) == 0);
}

// The frame that was being made turned black with the levels of before, and was blanked by another tilt's rows.
TEST_CASE("What is asked for while a frame is made is in force with the next one", "[cigi]") {
  Station station;
  const sensors::Sensor own = station.session->scene()->description.sensor;
  const auto middle_deg = static_cast<float>(
      core::degrees(own.display.cscope_top_rad - own.display.cscope_span_rad / 2));
  station.hear(message(1, {view_definition(32, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, middle_deg)}));
  station.ig.begin_frame();
  live::LiveFrame frame = grey_frame(station.session->scene());
  station.hear(message(2, {view_definition(0, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F),
                           sensor_control(2, 0.5F, 0.5F, 0.0F)}));
  // Over HTTP.
  session::SensorSettings tilted;
  tilted.boresight_elevation_rad = own.antenna.boresight_elevation_rad + core::radians(2.0);
  station.session->set(tilted);
  station.ig.dress(frame);
  CHECK(lit(frame.bscope.pixels) == own.scan.columns * own.range.cells);
  CHECK(frame.bscope.pixels.front() == 9);
  CHECK(lit(frame.cscope.pixels) == own.scan.columns * (own.display.cscope_rows / 2));
  station.ig.begin_frame();
  frame = grey_frame(station.session->scene());
  station.ig.dress(frame);
  CHECK(lit(frame.bscope.pixels) + lit(frame.cscope.pixels) + lit(frame.received_W) == 0);
}

TEST_CASE("Date and time of the host's world are told, impossible ones counted", "[cigi]") {
  Station station;
  const auto celestial = [](std::uint8_t hour, std::uint32_t date, std::uint8_t flags = 16) {
    return Packet(9, 16, false)
        .put(2, hour)
        .put<std::uint8_t>(3, 5)
        .put(4, flags)
        .put(8, date)
        .bytes();
  };
  CHECK(station.told().host_time.empty());
  station.hear(message(1, {celestial(6, 2'29'2024)}));
  CHECK(station.told().host_time == "2024-02-29T06:05Z");
  station.hear(
      message(2, {celestial(6, 2'29'2023), celestial(24, 2'28'2023), celestial(7, 2'28'2023, 0),
                  celestial(7, 4294967295U), celestial(7, 257'01'2024)}));
  CHECK(station.told().host_time == "2024-02-29T06:05Z");
  CHECK(all_of(station.told().unused_packets) == 5);
}
