// A request to stop is seen inside the long bodies of a cast's loops, not only between them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "core/parallel.h"
#include "core/stop.h"
#include "tests/renderer/city_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// From a request to stop, `after_s` into a cast, to the end of the cast.
double seconds_to_stop(const renderer::Caster& caster, const sensors::AntennaFrame& antenna,
                       double after_s) {
  core::StopSource source;
  const core::StopToken token = source.token();
  std::chrono::steady_clock::time_point asked;
  std::thread asker([&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    asked = std::chrono::steady_clock::now();
    source.request();
  });
  const auto stopped_cast = [&] {
    const core::StopScope scope(token);
    return tests::cast_level(caster, 0, antenna);
  };
  CHECK_THROWS_AS(stopped_cast(), core::Stopped);
  const auto ended = std::chrono::steady_clock::now();
  asker.join();
  return std::chrono::duration<double>(ended - asked).count();
}

// On one thread: `bodies` of the loop, one after the other, take the time of a cast.
void check_stop(const renderer::Caster& caster, const sensors::AntennaFrame& antenna,
                const renderer::FanSums& whole, double whole_s, int bodies) {
  const double body_s = whole_s / bodies;
  // Asked for in the first body, a stop that waited for its end would take most of a body's time. A
  // busy machine only lengthens what is measured: the best of five.
  double least_s = whole_s;
  for (int trial = 0; trial < 5; ++trial)
    least_s = std::min(least_s, seconds_to_stop(caster, antenna, body_s / 8));
  INFO(bodies << " bodies of " << body_s << " s");
  CHECK(least_s < body_s / 2);
  // And nothing of what was stopped is left in the thread's buffers.
  const renderer::FanSums again = tests::cast_level(caster, 0, antenna);
  CHECK(tests::same_bytes(again.range_W_per_rad, whole.range_W_per_rad));
  CHECK(tests::same_bytes(again.elevation_W_m3_per_rad, whole.elevation_W_m3_per_rad));
}

}  // namespace

TEST_CASE("A stop ends a cast within a part of a sub-column, and the next cast is whole",
          "[stop]") {
  const renderer::World world = tests::city_world(tests::narrow(1), tests::everywhere);
  const sensors::AntennaFrame level = tests::level_antenna({0.0, 0.0, tests::kHeight_m});
  sensors::AntennaFrame rolled = level;
  constexpr double kRoll_rad = 0.3;
  rolled.up = std::cos(kRoll_rad) * level.up + std::sin(kRoll_rad) * level.right;
  rolled.right = std::cos(kRoll_rad) * level.right - std::sin(kRoll_rad) * level.up;
  renderer::Sampling slices = tests::slices(1);
  slices.slices_per_sub_column = 4096;
  renderer::Sampling fewer = slices;  // whose sixteenth part is long enough
  fewer.slices_per_sub_column = 1024;
  renderer::Sampling rays;
  rays.sub_columns = 1;
  rays.rays_per_cell = 2000.0;
  const renderer::ProfileCaster by_slices(world, slices);
  const renderer::ProfileCaster by_fewer_slices(world, fewer);
  const renderer::RayCaster by_rays(world, rays);
  const core::ThreadLimit one(1);
  const auto check = [](const renderer::Caster& caster, const sensors::AntennaFrame& antenna,
                        const auto& bodies_of) {
    const auto begin = std::chrono::steady_clock::now();
    const renderer::FanSums whole = tests::cast_level(caster, 0, antenna);
    check_stop(caster, antenna, whole, seconds_since(begin), bodies_of(whole));
  };
  SECTION("slices, a body a sub-column") {
    check(by_slices, level, [](const renderer::FanSums& sums) { return sums.sub_columns; });
  }
  SECTION("slices of a rolled antenna, in 16 parts") {
    check(by_fewer_slices, rolled, [](const renderer::FanSums&) { return 16; });
  }
  SECTION("rays, a body a group") {
    check(by_rays, level, [](const renderer::FanSums& sums) {
      return sums.sub_columns / renderer::kGroupAzimuths;
    });
  }
}
