// Hard cases A02 and A03 as pictures: no rain, and rain that swallows everything.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kGrass;

namespace {

atmosphere::Weather only_rain(double rate_mm_per_h) {
  atmosphere::Weather weather;
  weather.rain_rate_mm_per_h = rate_mm_per_h;
  weather.rain_top_m = 12000.0;
  weather.simulate_gas = weather.simulate_fog = false;
  return weather;
}

renderer::World grass(const sensors::Sensor& sensor, double half_extent_m) {
  return tests::world(
      sensor, tests::ground(half_extent_m, 100.0, [](double, double) { return 0.0; }), {kGrass});
}

renderer::Frame frame_of(const renderer::World& world, double height_m,
                         const renderer::Effects& effects) {
  return renderer::render_frame(world, renderer::sampling_for(2.0), {}, effects,
                                tests::level_pose(height_m));
}

bool same_pictures(const renderer::Frame& a, const renderer::Frame& b) {
  return a.bscope_W == b.bscope_W && a.cscope_W_m3 == b.cscope_W_m3 &&
         a.bscope_grey == b.bscope_grey && a.cscope_grey == b.cscope_grey;
}

}  // namespace

TEST_CASE("A02 no rain and nearly no rain give the picture of clear air, value for value",
          "[weather_hard_cases][A02]") {
  const renderer::Effects effects{{core::EffectId::thermal_noise, core::EffectId::rain_echo}};
  renderer::World world = grass(tests::hivision(4), 4000.0);
  const renderer::Frame clear = frame_of(world, 60.0, effects);
  REQUIRE(*std::max_element(clear.bscope_W.begin(), clear.bscope_W.end()) > 0.0);

  world.attenuation = atmosphere::PathAttenuation(only_rain(0.0), 35e9);
  world.volume_echo.emplace(only_rain(0.0), 35e9);
  CHECK(same_pictures(frame_of(world, 60.0, effects), clear));

  // 1e-300 mm/h: a loss and an echo far below the last digit.
  world.attenuation = atmosphere::PathAttenuation(only_rain(1e-300), 35e9);
  world.volume_echo.emplace(only_rain(1e-300), 35e9);
  CHECK(frame_of(world, 60.0, effects).bscope_grey == clear.bscope_grey);
}

TEST_CASE("A03 behind 435 dB of rain every pixel is the noise floor, exactly",
          "[weather_hard_cases][A03]") {
  sensors::Sensor sensor = tests::hivision(4);
  sensor.range = {10000.0 - 8 * 6.67, 6.67, 16};
  constexpr double kAntenna_m = 600.0;
  const renderer::Effects noisy{{core::EffectId::thermal_noise}};
  renderer::World world = grass(sensor, 12000.0);
  const renderer::Frame clear = frame_of(world, kAntenna_m, {});
  const renderer::Frame clear_noisy = frame_of(world, kAntenna_m, noisy);
  world.attenuation = atmosphere::PathAttenuation(only_rain(100.0), 35e9);
  const renderer::Frame wet = frame_of(world, kAntenna_m, {});
  const renderer::Frame wet_noisy = frame_of(world, kAntenna_m, noisy);
  const renderer::Frame noise =
      frame_of(tests::world(sensor, std::nullopt, {kGrass}), kAntenna_m, noisy);

  for (std::size_t i = 0; i < wet.bscope_W.size(); ++i) {
    // What a ray returns is single precision, which ends at 1e-45: that little may be nothing.
    REQUIRE(clear.bscope_W[i] > 0.0);
    CHECK(wet.bscope_W[i] >= 0.0);
    CHECK(wet.bscope_W[i] <= 1e-43 * clear.bscope_W[i]);
    CHECK(wet.bscope_grey[i] == 0.0);
    CHECK(clear_noisy.bscope_grey[i] > noise.bscope_grey[i]);
  }
  CHECK(wet_noisy.bscope_grey == noise.bscope_grey);
  CHECK(wet_noisy.cscope_grey == noise.cscope_grey);

  // Past the end of double, 3076 dB: nothing is left, and that is black too.
  sensor.range.minimum_m = 80000.0;
  renderer::World far = grass(sensor, 90000.0);
  far.attenuation = atmosphere::PathAttenuation(only_rain(100.0), 35e9);
  const renderer::Frame drowned = frame_of(far, 6000.0, noisy);
  CHECK(std::all_of(drowned.bscope_W.begin(), drowned.bscope_W.end(),
                    [](double power_W) { return power_W == 0.0; }));
  CHECK(drowned.bscope_grey ==
        frame_of(tests::world(sensor, std::nullopt, {kGrass}), 6000.0, noisy).bscope_grey);
}
