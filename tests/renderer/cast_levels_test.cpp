// Samples in levels (CastPass): evenly between each other, the same power, group by group.
#include <catch2/catch.hpp>

#include "tests/renderer/city_world.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using tests::kHeight_m;
using tests::total;

TEST_CASE("Each level of slices is the plain sampling with twice as many as the one before",
          "[levels]") {
  const renderer::World world = tests::city_world(tests::narrow(12), tests::everywhere);
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  const renderer::ProfileCaster caster(world, tests::slices(4));
  const std::uint64_t first = tests::cast_level(caster, 0, antenna).slices;
  for (int level = 0; level <= 4; ++level) {
    INFO("level " << level);
    const renderer::FanSums sums = tests::cast_level(caster, level, antenna);
    CHECK(sums.slices == first << level);
    renderer::Sampling plain = tests::slices(4);
    plain.slices_per_sub_column = 1 << level;
    CHECK(sums.range_W_per_rad ==
          tests::cast_level(renderer::ProfileCaster(world, plain), 0, antenna).range_W_per_rad);
  }
}

TEST_CASE("Four levels of slices take nine tenths of the error away", "[levels]") {
  // Of rough ground alone, and of a city on level ground. Edges that fall between slices would leave
  // more than an eighth of it.
  std::uint64_t post = 0;
  const renderer::World rough = tests::world(
      tests::narrow(12),
      tests::ground(1300.0, 25.0, [&](double, double) { return 20.0 * tests::uniform(3, ++post); }),
      tests::city_library());
  const renderer::World city = tests::city_world(tests::narrow(12), tests::everywhere);
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m + 20.0});
  for (const renderer::World* world : {&rough, &city}) {
    const renderer::ProfileCaster caster(*world, tests::slices(1));
    const renderer::FanSums many = tests::cast_level(caster, 7, antenna);
    const auto error = [&](int level) {
      const renderer::FanSums sums = tests::cast_level(caster, level, antenna);
      double square = 0.0, whole = 0.0;
      for (std::size_t i = 0; i < sums.range_W_per_rad.size(); ++i) {
        square += std::pow(sums.range_W_per_rad[i] - many.range_W_per_rad[i], 2);
        whole += std::pow(many.range_W_per_rad[i], 2);
      }
      return std::sqrt(square / whole);
    };
    INFO((world == &city ? "city" : "rough ground"));
    CHECK(error(4) < 0.1 * error(0));
    CHECK(error(0) > 1e-4);
  }
}

TEST_CASE("Flat ground returns the same power at every level", "[levels]") {
  // Even gain and constant gamma: slices are then exact to 1e-9.
  sensors::Sensor sensor = tests::even_hivision(12);
  sensor.range.cells = 105;
  const renderer::World world = tests::world(sensor, tests::level_ground(), {tests::kGamma});
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  const renderer::ProfileCaster by_slices(world, tests::slices(4));
  const renderer::RayCaster by_rays(world, renderer::sampling_for(4.0));
  const renderer::FanSums first = tests::cast_level(by_slices, 0, antenna);
  const double first_rays_W = total(tests::cast_level(by_rays, 0, antenna).range_W_per_rad);
  std::uint64_t rays = tests::cast_level(by_rays, 0, antenna).rays;
  for (int level = 1; level <= 5; ++level) {
    INFO("level " << level);
    const renderer::FanSums sums = tests::cast_level(by_slices, level, antenna);
    double largest = 0.0;
    for (std::size_t i = 0; i < sums.range_W_per_rad.size(); ++i)
      if (first.range_W_per_rad[i] > 0.0)
        largest =
            std::max(largest, std::abs(sums.range_W_per_rad[i] / first.range_W_per_rad[i] - 1.0));
    CHECK(largest < 1e-9);
    // Rows weigh pieces by the range in their middle: 6e-8 measured.
    CHECK(total(sums.elevation_W_m3_per_rad) ==
          Approx(total(first.elevation_W_m3_per_rad)).epsilon(1e-6));
    // Rays stand for what they hit in the middle of their interval.
    const renderer::FanSums of_rays = tests::cast_level(by_rays, level, antenna);
    CHECK(total(of_rays.range_W_per_rad) == Approx(first_rays_W).epsilon(1e-3));
    CHECK(static_cast<double>(of_rays.rays) == Approx(static_cast<double>(rays)).epsilon(0.2));
    rays += of_rays.rays;
  }
}

TEST_CASE("Groups that are not asked for keep what they hold", "[levels]") {
  constexpr double kHeld = 7.0;
  const std::vector<std::uint32_t> asked{1, 4};
  const sensors::AntennaFrame antenna = tests::level_antenna({0.0, 0.0, kHeight_m});
  renderer::World world = tests::city_world(tests::narrow(24), tests::everywhere);
  const auto check_kept = [&](const renderer::Sampling& sampling) {
    const auto caster = tests::caster_of(world, sampling);
    for (int level = 0; level <= 3; ++level) {
      INFO("level " << level);
      const renderer::FanSums all = tests::cast_level(*caster, level, antenna);
      renderer::FanSums sums = all;
      const auto fill = [&](std::vector<double>& values) {
        std::fill(values.begin(), values.end(), kHeld);
      };
      fill(sums.range_W_per_rad);
      fill(sums.elevation_W_m3_per_rad);
      renderer::SightLines none;
      caster->cast(antenna, true, {level, &asked}, sums, none);
      const auto check = [&](const std::vector<double>& found, const std::vector<double>& cast,
                             int bins) {
        std::vector<double> expected(found.size(), kHeld);
        const std::ptrdiff_t count = std::ptrdiff_t{renderer::kGroupAzimuths} * bins;
        for (const std::ptrdiff_t group : asked)
          std::copy_n(cast.begin() + group * count, count, expected.begin() + group * count);
        CHECK(found == expected);
      };
      check(sums.range_W_per_rad, all.range_W_per_rad, sums.cells);
      check(sums.elevation_W_m3_per_rad, all.elevation_W_m3_per_rad, sums.rows);
      CHECK(sums.rays + sums.slices < (all.rays + all.slices) / 2);
      CHECK(sums.rays + sums.slices > 0);
    }
  };
  check_kept(renderer::sampling_for(4.0));
  check_kept(tests::slices(4));
  // A box in the middle of the fan is left to rays: group 4 is theirs, group 1 is not.
  tests::solids_of(world).others = {{{-30.0, 600.0, 0.0}, {10.0, 620.0, 9.0}}};
  check_kept(tests::slices(4));
}
