// The simulator's weather on its way to the radar.
#include "live/simulator_weather.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/feeds/native_fdm_bytes.h"
#include "tests/feeds/xplane_bytes.h"
#include "tests/live/live_scene.h"

using namespace fanbeam;
using nlohmann::json;

namespace {

json body_of(double visibility_m, std::optional<double> rain_norm,
             std::optional<double> snow_norm) {
  feeds::AircraftState state;
  state.visibility_m = visibility_m;
  state.rain_norm = rain_norm;
  state.snow_norm = snow_norm;
  return json::parse(live::weather_body(state));
}

void send(live::Feed& feed, int clock_s, const std::string& weather) {
  const std::string line =
      "fanbeam,2," + std::to_string(clock_s) + ",52,10,1000,800,0,0,0,100,0,0," + weather;
  feed.take({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
}

}  // namespace

TEST_CASE("Rain and snow fall within their WMO classes", "[simulator_weather]") {
  const auto rain = [](double norm) {
    return body_of(9000.0, norm, 0.0)["rain_rate_mm_per_h"].get<double>();
  };
  const auto snow = [](double norm) {
    return body_of(9000.0, 0.0, norm)["snow_rate_mm_per_h"].get<double>();
  };
  CHECK(rain(0.0) == 0.0);
  CHECK(rain(-3.0) == 0.0);
  CHECK((rain(1.0 / 3.0) > 0.1 && rain(1.0 / 3.0) < 2.5));
  CHECK((rain(2.0 / 3.0) > 2.5 && rain(2.0 / 3.0) < 10.0));
  CHECK((rain(1.0) > 10.0 && rain(1.0) < 50.0));
  CHECK(rain(3.0) == rain(1.0));
  CHECK((snow(1.0 / 3.0) > 0.1 && snow(1.0 / 3.0) < 1.0));
  CHECK((snow(2.0 / 3.0) > 1.0 && snow(2.0 / 3.0) < 5.0));
  CHECK(snow(1.0) > 5.0);
  double before = 0.0;
  for (double norm = 0.0; norm <= 1.0; norm += 0.01) {
    CHECK(rain(norm) >= before);
    before = rain(norm);
  }
}

TEST_CASE("Dry snow has no rain beside it, and haze is no fog", "[simulator_weather]") {
  const json both = body_of(9000.0, 0.9, 0.2);
  CHECK(both["rain_rate_mm_per_h"] > 0.0);
  CHECK(both["snow_rate_mm_per_h"] == 0.0);
  const json sleet = body_of(9000.0, 0.1, 0.9);
  CHECK(sleet["rain_rate_mm_per_h"] == 0.0);
  CHECK(sleet["snow_rate_mm_per_h"] > 0.0);
  CHECK_FALSE(both.contains("visibility_m"));
  // Unless it melts on its way down.
  feeds::AircraftState state;
  state.rain_norm = 0.9;
  state.snow_norm = 0.2;
  atmosphere::Weather melting;
  melting.melting_height_m = 1500.0;
  const json layers = json::parse(live::weather_body(state, melting));
  CHECK(layers["rain_rate_mm_per_h"] == both["rain_rate_mm_per_h"]);
  CHECK(layers["snow_rate_mm_per_h"] == body_of(9000.0, 0.0, 0.2)["snow_rate_mm_per_h"]);
  CHECK_FALSE(body_of(1000.0, {}, {}).contains("visibility_m"));
  CHECK(body_of(347.0, {}, {})["visibility_m"] == 350.0);
  CHECK(body_of(0.0, {}, {})["visibility_m"] == 10.0);
  CHECK(body_of(-1e300, {}, {})["visibility_m"] == 10.0);
}

TEST_CASE("What the simulator changes is set, and what a person sets stands until then",
          "[simulator_weather]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Feed feed(session->scene(), core::VerticalDatum::scene, feeds::kProtocols[1]);
  live::SimulatorWeather weather(desk, feed);
  const auto begin = live::Clock::now();
  const auto after = [&](int seconds) { weather.follow(begin + std::chrono::seconds(seconds)); };
  const auto rain = [&] { return session->scene()->weather.rain_rate_mm_per_h; };
  const auto before = session->now();
  after(0);
  CHECK(session->now() == before);  // no packet yet
  send(feed, 1, "400,1,0");
  after(1);
  CHECK(rain() == 22.0);
  CHECK(session->scene()->weather.visibility_m == 400.0);
  send(feed, 2, "400,0,0.5");
  after(2);
  CHECK(rain() == 22.0);  // too soon
  after(3);
  CHECK(rain() == 0.0);
  CHECK(session->scene()->weather.snow_rate_mm_per_h == Approx(1.5));
  desk.control("/api/weather", R"({"rain_rate_mm_per_h": 5})");
  send(feed, 3, "401,0,0.5");
  after(6);
  CHECK(rain() == 5.0);
  send(feed, 4, "9000,0,0");
  after(9);
  CHECK(rain() == 0.0);
  CHECK_FALSE(session->scene()->weather.visibility_m.has_value());
}

// It was clamped: of -1 m of visibility the densest fog, of 7 of rain a cloudburst, and nobody was told.
TEST_CASE("Weather of a simulator that cannot be is not told, and counted; its pose stays",
          "[simulator_weather]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Feed feed(session->scene(), core::VerticalDatum::scene, feeds::kProtocols[1]);
  live::SimulatorWeather weather(desk, feed);
  const auto begin = live::Clock::now();
  send(feed, 1, "400,0.5,0");
  weather.follow(begin);
  const double rain_rate_mm_per_h = session->scene()->weather.rain_rate_mm_per_h;
  CHECK(rain_rate_mm_per_h > 0.0);
  send(feed, 2, "0,7,-0.1");
  send(feed, 3, "-1,1.0001,2");
  weather.follow(begin + std::chrono::seconds(3));
  CHECK(session->scene()->weather.rain_rate_mm_per_h == rain_rate_mm_per_h);
  CHECK(session->scene()->weather.visibility_m == 400.0);
  CHECK(feed.mailbox().count() == 3);
  live::Status told;
  feed.tell(told);
  CHECK(told.bad_packets.empty());
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;
  CHECK(told.unused_packets == Counts{{"weather that cannot be", 6}});
  feed.tell(told);  // of a second source
  CHECK(told.unused_packets == Counts{{"weather that cannot be", 12}});
}

// Each change of the visibility took the rain away.
TEST_CASE("What a protocol does not tell stays as it was set", "[simulator_weather]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Feed feed(session->scene(), core::VerticalDatum::scene);  // native-fdm: visibility alone
  live::SimulatorWeather weather(desk, feed);
  const auto begin = live::Clock::now();
  const auto tell = [&](float visibility_m, int after_s) {
    auto packet = tests::native_fdm_bytes(0.9, 0.2);
    tests::put(packet, 364, visibility_m);
    feed.take(packet);
    weather.follow(begin + std::chrono::seconds(after_s));
  };
  const auto now = [&] { return session->scene()->weather; };
  desk.control("/api/weather", R"({"rain_rate_mm_per_h": 5, "visibility_m": 400})");
  tell(5000.0F, 0);
  CHECK(now().rain_rate_mm_per_h == 5.0);
  CHECK_FALSE(now().visibility_m.has_value());
  desk.control("/api/weather", R"({"rain_rate_mm_per_h": 0, "snow_rate_mm_per_h": 2})");
  tell(300.0F, 3);
  CHECK(now().rain_rate_mm_per_h == 0.0);
  CHECK(now().snow_rate_mm_per_h == 2.0);
  CHECK(now().visibility_m == 300.0);
}

// What was read before it was written back as it had been.
TEST_CASE("What a person sets while the simulator's weather is being set stands",
          "[simulator_weather][threads]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  feeds::AircraftState state;
  state.visibility_m = 300.0;
  std::thread person;
  desk.change_weather([&](const atmosphere::Weather& now) {
    person = std::thread(
        [&] { desk.control("/api/weather", R"({"rain_rate_mm_per_h": 5, "visibility_m": 400})"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return live::weather_body(state, now);
  });
  person.join();
  CHECK(session->scene()->weather.rain_rate_mm_per_h == 5.0);
  CHECK(session->scene()->weather.visibility_m == 400.0);
}

// X-Plane tells visibility and rain, and each only once it was asked.
TEST_CASE("A simulator that tells no weather changes none, fog by its water stays",
          "[simulator_weather]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  atmosphere::Weather foggy = session->scene()->weather;
  foggy.visibility_m.reset();
  foggy.liquid_water_g_per_m3 = 0.3;
  session->set(foggy);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Feed feed(session->scene(), core::VerticalDatum::scene, feeds::kProtocols[2]);
  live::SimulatorWeather weather(desk, feed);
  const auto begin = live::Clock::now();
  const auto before = session->now();
  feed.take(tests::xplane_position(52.0, 10.0, 300.0));
  weather.follow(begin);
  CHECK(session->now() == before);
  const auto rain = [&] { return session->scene()->weather.rain_rate_mm_per_h; };
  feed.tell_rain(1.0);
  weather.follow(begin + std::chrono::seconds(1));
  CHECK(rain() == 22.0);
  CHECK(atmosphere::fog_liquid_water_g_per_m3(session->scene()->weather) ==
        Approx(0.3).epsilon(1e-9));
  // What it tells later counts then, also where it is none.
  live::Feed dry(session->scene(), core::VerticalDatum::scene, feeds::kProtocols[2]);
  live::SimulatorWeather later(desk, dry);
  dry.take(tests::xplane_position(52.0, 10.0, 300.0));
  dry.tell_visibility(5000.0);
  later.follow(begin);
  CHECK(rain() == 22.0);
  dry.tell_rain(0.0);
  later.follow(begin + std::chrono::seconds(3));
  CHECK(rain() == 0.0);
}

TEST_CASE("Rain that is told to fall takes the place of snow that is not told",
          "[simulator_weather]") {
  atmosphere::Weather snowing;
  snowing.snow_rate_mm_per_h = 4.0;
  const auto body = [&](const feeds::AircraftState& state) {
    return json::parse(live::weather_body(state, snowing));
  };
  feeds::AircraftState state;
  state.rain_norm = 0.3;
  CHECK(body(state)["rain_rate_mm_per_h"] > 0.0);
  CHECK(body(state)["snow_rate_mm_per_h"] == 0.0);
  state.rain_norm = 0.0;
  CHECK(body(state)["rain_rate_mm_per_h"] == 0.0);
  CHECK(body(state)["snow_rate_mm_per_h"] == 4.0);
  // Below a melting layer both may fall: whoever tells neither changes neither.
  snowing.rain_rate_mm_per_h = 3.0;
  state.rain_norm.reset();
  state.visibility_m = 5000.0;
  CHECK(body(state)["rain_rate_mm_per_h"] == 3.0);
  CHECK(body(state)["snow_rate_mm_per_h"] == 4.0);
}

// It ended the channel.
TEST_CASE("Weather that the scene cannot have is told, and the channel goes on with what it had",
          "[simulator_weather]") {
  tests::TemporaryFolder folder;
  const auto session = tests::live_session(folder);
  atmosphere::Weather cold = session->scene()->weather;
  cold.temperature_C = -50.0;
  cold.visibility_m.reset();
  cold.liquid_water_g_per_m3.reset();
  session->set(cold);
  live::Hub hub;
  const live::Desk desk(*session, hub);
  live::Feed feed(session->scene(), core::VerticalDatum::scene, feeds::kProtocols[1]);
  live::SimulatorWeather weather(desk, feed);
  const auto begin = live::Clock::now();
  send(feed, 1, "400,0,0");
  weather.follow(begin);
  CHECK(weather.refusal().find("temperature_C") != std::string::npos);
  CHECK_FALSE(session->scene()->weather.visibility_m.has_value());
  send(feed, 2, "9000,0.5,0");
  weather.follow(begin + std::chrono::seconds(3));
  CHECK(weather.refusal().empty());
  CHECK(session->scene()->weather.rain_rate_mm_per_h > 0.0);
}
