// Weather, targets and sampling set through C do what a session's do.
#include <catch2/catch.hpp>
#include <cmath>

#include "bindings/c/fanbeam.h"
#include "session/session.h"
#include "tests/bindings/c_session.h"

using namespace fanbeam;
using tests::Buffers;
using tests::CSession;
using tests::sized;
using tests::TemporaryFolder;
using tests::told;

namespace {

const std::string kMast = R"(
[[target]]
name = "mast"
at = { latitude_deg = 52.004, longitude_deg = 10.0 }
rcs = { shape = "constant", rcs_dBsm = 30 }
above_ground_m = 20.0
)";

fanbeam_weather weather_of(std::uint32_t given, double visibility_m, double rain_rate_mm_per_h) {
  fanbeam_weather weather = sized<fanbeam_weather>();
  weather.given = given;
  weather.visibility_m = visibility_m;
  weather.rain_rate_mm_per_h = rain_rate_mm_per_h;
  return weather;
}

// Over the runway, 300 m behind its threshold, 30 m up.
fanbeam_target target_called(const char* name) {
  fanbeam_target target = sized<fanbeam_target>();
  target.name = name;
  target.latitude_rad = 52.003 * 3.14159265358979 / 180.0;
  target.longitude_rad = 10.0 * 3.14159265358979 / 180.0;
  target.height_m = 80.0;
  return target;
}

}  // namespace

TEST_CASE("Rain set through C is rain of a session, and goes again", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose pose = tests::flown(c);
  const Buffers dry = tests::c_rendered(c, pose);
  const fanbeam_weather rain = weather_of(FANBEAM_RAIN_RATE, std::nan(""), 20.0);  // fog stays
  REQUIRE(fanbeam_set_weather(c.get(), &rain) == FANBEAM_OK);
  const Buffers wet = tests::c_rendered(c, pose);
  CHECK_FALSE((wet == dry));

  core::ProblemList problems;
  session::Setup setup;
  setup.shipped = FANBEAM_SOURCE_DIR;
  setup.seed = 7;
  session::Session session(folder.path(), setup, problems);
  session.set(session::Samples{2.0});
  atmosphere::Weather weather = session.scene()->weather;
  weather.rain_rate_mm_per_h = 20.0;
  session.set(weather);
  const renderer::Frame frame = session.render(tests::core_pose(pose), 0);
  CHECK((wet.bscope_W == frame.bscope_W));

  const fanbeam_weather none = weather_of(FANBEAM_RAIN_RATE, 0.0, 0.0);
  REQUIRE(fanbeam_set_weather(c.get(), &none) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == dry));
}

TEST_CASE("Fog set through C is there, or gone; what is wrong changes nothing", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose pose = tests::flown(c);
  const Buffers before = tests::c_rendered(c, pose);
  const auto set = [&](const fanbeam_weather& weather) {
    return fanbeam_set_weather(c.get(), &weather);
  };
  REQUIRE(set(weather_of(FANBEAM_VISIBILITY, 50.0, 0.0)) == FANBEAM_OK);
  const Buffers thick = tests::c_rendered(c, pose);
  CHECK_FALSE((thick == before));
  REQUIRE(set(weather_of(FANBEAM_NO_FOG, 0.0, 0.0)) == FANBEAM_OK);
  const Buffers clear = tests::c_rendered(c, pose);
  CHECK_FALSE((clear == thick));
  REQUIRE(set(weather_of(FANBEAM_VISIBILITY, 400.0, 0.0)) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == before));

  CHECK(set(weather_of(FANBEAM_VISIBILITY | FANBEAM_RAIN_RATE, std::nan(""), -1.0)) ==
        FANBEAM_BAD_INPUT);
  CHECK(tests::problems_told() == 2);
  CHECK(told("weather.visibility_m"));
  CHECK(told("weather.rain_rate_mm_per_h"));
  CHECK(set(weather_of(FANBEAM_VISIBILITY | FANBEAM_NO_FOG, 100.0, 0.0)) == FANBEAM_BAD_INPUT);
  CHECK(set(weather_of(64, 0.0, 0.0)) == FANBEAM_BAD_INPUT);
  fanbeam_weather other = weather_of(FANBEAM_RAIN_RATE, 0.0, 20.0);
  other.size = 16;
  CHECK(set(other) == FANBEAM_BAD_SIZE);
  CHECK((tests::c_rendered(c, pose) == before));
}

TEST_CASE("Targets set through C add up one by one, and go back together", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder, tests::kSmallScene + kMast);
  const fanbeam_pose pose = tests::flown(c, 0);
  const Buffers before = tests::c_rendered(c, pose);
  const auto set = [&](const fanbeam_target& target) {
    return fanbeam_set_target(c.get(), &target);
  };
  fanbeam_target truck = target_called("truck");
  CHECK(set(truck) == FANBEAM_BAD_INPUT);  // new, and without an rcs
  CHECK(told("E-REF target.name"));
  truck.given = FANBEAM_RCS;
  truck.rcs_m2 = 1000.0;
  REQUIRE(set(truck) == FANBEAM_OK);
  const Buffers one = tests::c_rendered(c, pose);
  CHECK_FALSE((one == before));
  fanbeam_target mast = target_called("mast");
  mast.latitude_rad += 1e-4;
  REQUIRE(set(mast) == FANBEAM_OK);
  const Buffers both = tests::c_rendered(c, pose);
  CHECK_FALSE((both == one));
  truck.given = 0;  // it is known by now
  REQUIRE(set(truck) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == both));

  fanbeam_target nobody = target_called("nobody");
  CHECK(set(nobody) == FANBEAM_BAD_INPUT);  // the third that the session has
  CHECK(told("E-REF target.name"));
  const fanbeam_target two[] = {mast, nobody};
  CHECK(fanbeam_set_targets(c.get(), two, 2) == FANBEAM_BAD_INPUT);
  CHECK(told("E-REF targets[1].name"));
  fanbeam_target beyond[] = {nobody, target_called(""), nobody};
  beyond[0].height_m = std::nan("");
  CHECK(fanbeam_set_targets(c.get(), beyond, 3) == FANBEAM_BAD_INPUT);
  INFO(fanbeam_last_error());
  CHECK(tests::problems_told() == 5);
  for (const char* problem :
       {"E-NONFINITE targets[0].height_m", "E-REF targets[0].name", "E-REF targets[1].name",
        "E-REF targets[2].name = \"nobody\" again", "E-REF targets[2].name = \"nobody\": "})
    CHECK(told(problem));
  CHECK(fanbeam_set_target(c.get(), beyond) == FANBEAM_BAD_INPUT);
  CHECK(tests::problems_told() == 2);
  CHECK(told("E-REF target.name"));
  nobody.name = "\xff";
  nobody.given = FANBEAM_RCS;
  CHECK(set(nobody) == FANBEAM_BAD_INPUT);
  CHECK(told("UTF-8"));
  mast.height_m = std::nan("");
  CHECK(set(mast) == FANBEAM_BAD_INPUT);
  CHECK((tests::c_rendered(c, pose) == both));
  // The mast goes home; what the truck was told of itself stays.
  REQUIRE(fanbeam_set_targets(c.get(), &truck, 1) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == one));
  REQUIRE(fanbeam_set_targets(c.get(), nullptr, 0) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == before));
}

TEST_CASE("Sampling set through C is a session's", "[bindings]") {
  const TemporaryFolder folder;
  const CSession c = tests::c_opened(folder);
  const fanbeam_pose pose = tests::flown(c);
  const Buffers two = tests::c_rendered(c, pose);
  REQUIRE(fanbeam_set_samples(c.get(), 1.0) == FANBEAM_OK);
  CHECK_FALSE((tests::c_rendered(c, pose) == two));
  CHECK(fanbeam_set_samples(c.get(), 0.1) == FANBEAM_BAD_INPUT);
  CHECK(fanbeam_set_samples(c.get(), std::nan("")) == FANBEAM_BAD_INPUT);
  REQUIRE(fanbeam_set_samples(c.get(), 2.0) == FANBEAM_OK);
  CHECK((tests::c_rendered(c, pose) == two));
}
