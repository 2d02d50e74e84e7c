// The fast ways to a beat signal against the exact one.
#include "signal/synthesis/beat_synthesis.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "core/random.h"
#include "signal/synthesis/keystone_synthesis.h"
#include "signal/synthesis/reference.h"
#include "signal/synthesis/spreading_kernel.h"
#include "signal/waveform/factories.h"
#include "tests/peak_memory.h"
#include "tests/signal/default_waveform.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

std::vector<ScatterPath> paths_between(int count, double least_m, double most_speed_mps) {
  std::vector<ScatterPath> paths;
  const core::RandomKey key{7, 902, 0};
  for (int i = 0; i < count; ++i) {
    const auto cell = static_cast<std::uint64_t>(i);
    const auto words = core::random_words(key, cell, 0);
    const auto amplitude = core::normal_pair(key, cell, 1);
    ScatterPath path;
    path.range_m = least_m + (230.0 - least_m) * core::uniform_from(words[0]);
    path.radial_speed_mps = most_speed_mps * (2.0 * core::uniform_from(words[1]) - 1.0);
    path.azimuth_rad = 2.0 * core::uniform_from(words[2]) - 1.0;
    path.elevation_rad = 0.2 * (core::uniform_from(words[3]) - 0.5);
    path.amplitude_sqrtW = {amplitude[0], amplitude[1]};
    paths.push_back(path);
  }
  return paths;
}

template <typename A, typename B>
double relative_error(const Cube<A>& cube, const Cube<B>& reference) {
  REQUIRE(cube.shape == reference.shape);
  double difference = 0.0, power = 0.0;
  for (std::size_t i = 0; i < cube.values.size(); ++i) {
    const std::complex<double> value(cube.values[i]), exact(reference.values[i]);
    difference += std::norm(value - exact);
    power += std::norm(exact);
  }
  return std::sqrt(difference / power);
}

Waveform chirps(int count, int slots) {
  ChirpSequenceParameters parameters;
  parameters.chirps = count;
  parameters.slots = slots;
  return chirp_sequence(parameters);
}

Array twelve() { return line_array(3, 4, 0.5 * core::kSpeedOfLight_mps / 76e9); }

}  // namespace

TEST_CASE("Spreading reaches the published errors of its widths", "[synthesis]") {
  // Type 1 against the direct sum: 64 modes, 200 points.
  struct Row {
    int width;
    double error;
  };
  for (const Row& row : {Row{4, 8.2e-4}, Row{5, 7.6e-5}, Row{6, 7.5e-6}, Row{7, 8.4e-7},
                         Row{8, 1.1e-7}, Row{10, 1.5e-9}, Row{12, 1.5e-11}}) {
    constexpr int kModes = 64, kCells = 128, kPoints = 200;
    const SpreadingKernel kernel(row.width);
    std::vector<std::complex<double>> grid(kCells), exact(kModes);
    for (int i = 0; i < kPoints; ++i) {
      const auto cell = static_cast<std::uint64_t>(i);
      const double x = core::uniform_from(core::random_words({3, 903, 0}, cell, 0)[0]);
      const auto normal = core::normal_pair({3, 903, 0}, cell, 1);
      const std::complex<double> amplitude(normal[0], normal[1]);
      const int first = static_cast<int>(std::ceil(x * kCells - 0.5 * row.width));
      const double u = 2.0 * (first - x * kCells + 0.5 * row.width) - 1.0;
      for (int tap = 0; tap < row.width; ++tap) {
        double weight = 0.0;
        for (int power = kernel.degree(); power >= 0; --power)
          weight = weight * u +
                   kernel.taps()[static_cast<std::size_t>(tap * (kernel.degree() + 1) + power)];
        grid[static_cast<std::size_t>((first + tap + kCells) % kCells)] += amplitude * weight;
      }
      for (int n = 0; n < kModes; ++n)
        exact[static_cast<std::size_t>(n)] +=
            amplitude * std::polar(1.0, 2.0 * core::kPi * (n - kModes / 2) * x);
    }
    double difference = 0.0, power = 0.0;
    for (int n = 0; n < kModes; ++n) {
      const double k = n - kModes / 2;
      std::complex<double> sum = 0.0;
      for (int i = 0; i < kCells; ++i)
        sum +=
            grid[static_cast<std::size_t>(i)] * std::polar(1.0, 2.0 * core::kPi * k * i / kCells);
      difference +=
          std::norm(sum / kernel.transform(k / kCells) - exact[static_cast<std::size_t>(n)]);
      power += std::norm(exact[static_cast<std::size_t>(n)]);
    }
    INFO("width " << row.width);
    CHECK(std::sqrt(difference / power) < 2.0 * row.error);
  }
}

TEST_CASE("Fast synthesis keeps 1e-4, and 1e-6 on request, with migration and time division",
          "[synthesis]") {
  const Waveform waveform = chirps(40, 3);
  const std::vector<ScatterPath> paths = paths_between(40, 3.0, 70.0);
  const DoubleCube exact = reference_beat(waveform, 0, twelve(), paths);
  CHECK(relative_error(synthesise_beat(waveform, 0, twelve(), paths), exact) < 1e-4);
  CHECK(relative_error(synthesise_beat(waveform, 0, twelve(), paths, {1e-6}), exact) < 1e-6);
  CHECK(relative_error(synthesise_beat_double(waveform, 0, twelve(), paths, {1e-8}), exact) < 1e-8);
}

TEST_CASE("The bend of a beat over its ramp is kept to first order in double too", "[synthesis]") {
  // Up to 2.8e-5 rad: left out, 1e-5 would be wrong; the second order is 1e-10.
  const Waveform waveform = chirps(24, 3);
  const std::vector<ScatterPath> paths = paths_between(40, 20.0, 0.5);
  const DoubleCube exact = reference_beat(waveform, 0, twelve(), paths);
  CHECK(relative_error(synthesise_beat_double(waveform, 0, twelve(), paths, {1e-9}), exact) < 1e-9);
}

TEST_CASE("Near and fast paths that no low polynomial follows keep the error too", "[synthesis]") {
  const Waveform waveform = chirps(256, 3);
  std::vector<ScatterPath> paths = paths_between(20, 30.0, 20.0);
  for (ScatterPath& path : paths) path.range_m = 0.3 + 0.01 * path.range_m;
  const DoubleCube exact = reference_beat(waveform, 0, twelve(), paths);
  CHECK(relative_error(synthesise_beat(waveform, 0, twelve(), paths), exact) < 1e-4);
}

TEST_CASE("Triangles, steps and coded stretches are synthesised by their own phases",
          "[synthesis]") {
  const std::vector<ScatterPath> paths = paths_between(6, 10.0, 40.0);
  for (const WaveformKind kind :
       {WaveformKind::continuous, WaveformKind::triangle, WaveformKind::two_slopes,
        WaveformKind::coded_triangle, WaveformKind::stepped, WaveformKind::sinusoidal}) {
    const Waveform waveform = tests::default_waveform(kind);
    for (int stage = 0; stage < waveform.stages(); ++stage) {
      INFO(std::string(name(kind)) << " stage " << stage);
      const DoubleCube exact = reference_beat(waveform, stage, {}, paths);
      CHECK(relative_error(synthesise_beat_double(waveform, stage, {}, paths), exact) < 1e-8);
    }
  }
}

TEST_CASE("The keystone grid keeps the error it states", "[synthesis]") {
  const Waveform waveform = chirps(64, 3);
  for (const double least_m : {5.0, 60.0}) {
    const std::vector<ScatterPath> paths = paths_between(60, least_m, 30.0);
    const DoubleCube exact = reference_beat(waveform, 0, twelve(), paths);
    for (const double kernel_error : {1e-2, 1e-3}) {
      const KeystoneBeat beat = keystone_beat(waveform, 0, twelve(), paths, {kernel_error});
      CHECK(relative_error(beat.cube, exact) < beat.estimated_error);
      CHECK(beat.estimated_error < 4e-3);
    }
  }
  CHECK_THROWS_AS(keystone_beat(triangle({}), 0, {}, {}), core::InputError);
}

TEST_CASE("A frame too long for the keystone grid is E-LIMIT before its samples take memory",
          "[synthesis]") {
  ChirpSequenceParameters parameters;
  parameters.ramp_s = parameters.interval_s = 0.01;
  parameters.chirps = 16;
  const Waveform waveform = chirp_sequence(parameters);  // 307 MB of samples
  const std::vector<ScatterPath> paths = paths_between(60, 60.0, 30.0);
  const Array array = line_array(1, 12, 0.5 * core::kSpeedOfLight_mps / 76e9);
  const tests::PeakMemory memory;
  CHECK_THROWS_WITH(keystone_beat(waveform, 0, array, paths),
                    Catch::Contains("E-LIMIT grid cells") && Catch::Contains("fewer chirps"));
  CHECK(memory.rise_MiB() < 64.0);
}

TEST_CASE("Elements above and before each other keep the keystone grid's error", "[synthesis]") {
  const Waveform waveform = chirps(64, 3);
  // Two heights, and a receiver set back: four rows. Far apart, so that the near field counts.
  Array spread = twelve();
  spread.transmitters_m[1].z = 0.04;
  spread.receivers_m[3].x = -0.03;
  spread.receivers_m[3].z = 0.01;
  for (const double least_m : {5.0, 60.0}) {
    const std::vector<ScatterPath> paths = paths_between(60, least_m, 30.0);
    const DoubleCube exact = reference_beat(waveform, 0, spread, paths);
    const KeystoneBeat beat = keystone_beat(waveform, 0, spread, paths);
    CAPTURE(least_m, beat.estimated_error);
    CHECK(relative_error(beat.cube, exact) < beat.estimated_error);
    CHECK(beat.estimated_error < (least_m < 10.0 ? 3e-2 : 4e-3));
  }
}

TEST_CASE("Beats have the same bits for any number of threads", "[synthesis]") {
  const Waveform waveform = chirps(48, 3);
  const std::vector<ScatterPath> paths = paths_between(300, 5.0, 40.0);
  const auto both = [&](int threads) {
    const core::ThreadLimit limit(threads);
    return std::pair{synthesise_beat(waveform, 0, twelve(), paths).values,
                     keystone_beat(waveform, 0, twelve(), paths).cube.values};
  };
  CHECK(both(1) == both(4));
}

TEST_CASE("Nothing in, nothing out", "[synthesis]") {
  const Waveform waveform = chirps(8, 3);
  for (const std::complex<float>& value : synthesise_beat(waveform, 0, twelve(), {}).values)
    REQUIRE(value == 0.0f);
  std::vector<ScatterPath> dark = paths_between(20, 10.0, 10.0);
  for (ScatterPath& path : dark) path.amplitude_sqrtW = 0.0;
  for (const std::complex<float>& value : synthesise_beat(waveform, 0, twelve(), dark).values)
    REQUIRE(value == 0.0f);
  CHECK_THROWS_AS(synthesise_beat(waveform, 0, twelve(), {}, {1e-12}), core::InputError);
}

TEST_CASE("The mixer leaves the difference tone alone", "[synthesis]") {
  // sin a sin b low-passed is a tone at the difference; a complex beat has no image at its negative.
  const Waveform waveform = chirps(8, 1);
  std::vector<ScatterPath> path = paths_between(1, 100.0, 0.0);
  path[0].amplitude_sqrtW = 1.0;
  const DoubleCube cube = reference_beat(waveform, 0, {}, path);
  const int samples = cube.shape.samples;
  const double turns = std::arg(cube.at(0, 0, 1) / cube.at(0, 0, 0)) / (2.0 * core::kPi);
  std::complex<double> tone = 0.0, image = 0.0;
  for (int n = 0; n < samples; ++n) {
    // A Blackman-Harris window, so that leakage hides nothing above -90 dB.
    const double x = 2.0 * core::kPi * n / samples;
    const double window =
        0.35875 - 0.48829 * std::cos(x) + 0.14128 * std::cos(2.0 * x) - 0.01168 * std::cos(3.0 * x);
    tone += window * cube.at(0, 0, n) * std::polar(1.0, -2.0 * core::kPi * turns * n);
    image += window * cube.at(0, 0, n) * std::polar(1.0, 2.0 * core::kPi * turns * n);
  }
  CHECK(20.0 * std::log10(std::abs(image) / std::abs(tone)) < -80.0);
}
