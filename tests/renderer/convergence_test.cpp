// R18: what more rays buy. The reference's rays are drawn at random inside their steps of elevation;
// passes over the same steps are independent of each other, finer steps are a stratified sample.
#include <catch2/catch.hpp>
#include <numeric>

#include "renderer/casting/ray_caster.h"
#include "tests/renderer/profile_closed_form.h"
#include "tests/renderer/usual_world.h"

using namespace fanbeam;
using tests::kHeight_m;

namespace {

constexpr int kSeeds = 16;
constexpr int kDensities = 11;  // 1 to 1024 rays per cell

struct Ladder {
  std::vector<double> rms;              // relative error of a cell, by step
  std::vector<double> mean, deviation;  // over seeds, of the relative error of all power
};

class FlatClutter {
 public:
  FlatClutter() : world_(world()) {
    const double far_m = world_.sensor.range.maximum_m();
    expected_W_per_rad_ =
        tests::closed_form(world_.sensor, {{{0.0, -kHeight_m}, {far_m, -kHeight_m}}});
  }

  Ladder ladder(bool independent) const {
    Ladder ladder;
    for (int step = 0; step < kDensities; ++step) {
      std::vector<double> biases;
      double squares = 0.0, count = 0.0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        const renderer::FanSums sums = cast(1 << step, independent, static_cast<unsigned>(seed));
        double bias = 0.0;
        const auto cells = static_cast<std::size_t>(sums.cells);
        for (std::size_t i = 0; i < sums.range_W_per_rad.size(); ++i) {
          const double error = sums.range_W_per_rad[i] / expected_W_per_rad_[i % cells] - 1.0;
          squares += error * error;
          bias += error;
          count += 1.0;
        }
        biases.push_back(bias / static_cast<double>(sums.range_W_per_rad.size()));
      }
      ladder.rms.push_back(std::sqrt(squares / count));
      const double mean = std::accumulate(biases.begin(), biases.end(), 0.0) / kSeeds;
      double variance = 0.0;
      for (const double bias : biases) variance += (bias - mean) * (bias - mean) / (kSeeds - 1);
      ladder.mean.push_back(mean);
      ladder.deviation.push_back(std::sqrt(variance / kSeeds));
    }
    return ladder;
  }

 private:
  static renderer::World world() {
    sensors::Sensor sensor = tests::even_hivision(1);
    sensor.range.cells = 24;
    return tests::world(sensor, tests::ground(1000.0, 250.0, [](double, double) { return 0.0; }),
                        {tests::kGamma});
  }
  renderer::FanSums cast(int rays, bool independent, std::uint64_t seed) const {
    renderer::Sampling sampling = renderer::reference_sampling(seed + 1);
    sampling.sub_columns = 1;
    sampling.largest_step_rad = 1.0;
    sampling.jittered_passes = independent ? rays : 1;
    sampling.rays_per_cell = independent ? 1.0 : rays;
    renderer::FanSums sums;
    renderer::RayCaster(world_, sampling)
        .cast(tests::level_antenna({0.0, 0.0, kHeight_m}), false, sums);
    return sums;
  }

  renderer::World world_;
  std::vector<double> expected_W_per_rad_;
};

// Of log(rms) over log(rays), by least squares.
double slope(const std::vector<double>& rms, std::size_t first = 0) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto count = static_cast<double>(rms.size() - first);
  for (std::size_t i = first; i < rms.size(); ++i) {
    const double u = static_cast<double>(i), v = std::log2(rms[i]);
    x += u / count;
    y += v / count;
    xx += u * u / count;
    xy += u * v / count;
  }
  return (xy - x * y) / (xx - x * x);
}

}  // namespace

TEST_CASE("R18: independent rays converge with slope -0.5 to the closed form, without a plateau",
          "[convergence]") {
  const Ladder ladder = FlatClutter().ladder(true);
  INFO("rms " << ladder.rms.front() << " to " << ladder.rms.back());
  CHECK(slope(ladder.rms) == Approx(-0.5).margin(0.07).epsilon(0.0));
  CHECK(slope(ladder.rms, 6) ==
        Approx(-0.5).margin(0.07).epsilon(0.0));  // the last decade and a half
  for (std::size_t i = 0; i < kDensities; ++i) {
    INFO((1 << i) << " rays per cell: bias " << ladder.mean[i] << " +- " << ladder.deviation[i]);
    CHECK(std::abs(ladder.mean[i]) <= 4.0 * ladder.deviation[i]);
  }
}

TEST_CASE("R18: stratified rays converge at least as fast", "[convergence]") {
  const Ladder ladder = FlatClutter().ladder(false);
  INFO("rms " << ladder.rms.front() << " to " << ladder.rms.back());
  CHECK(slope(ladder.rms) <= -0.5);
  for (std::size_t i = 1; i < kDensities; ++i) {
    INFO((1 << i) << " rays per cell: " << ladder.rms[i] << ", bias " << ladder.mean[i] << " +- "
                  << ladder.deviation[i]);
    // Not below the step before: a ray whose range is rounded over a cell's edge weighs 1 / rays.
    CHECK(ladder.rms[i] <= ladder.rms[0] * std::sqrt(1.0 / (1 << i)));
    CHECK(std::abs(ladder.mean[i]) <= 4.0 * ladder.deviation[i]);
  }
}
