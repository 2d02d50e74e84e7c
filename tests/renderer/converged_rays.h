// Frames of the profile caster held against frames of converged rays.
#pragma once

#include <catch2/catch.hpp>

#include "sensors/display/display.h"
#include "tests/renderer/profile_closed_form.h"

namespace fanbeam::tests {

struct Powers {
  std::vector<double> bscope_W, cscope_W_m3;
};

inline Powers render(const renderer::World& world, const renderer::Sampling& sampling,
                     const renderer::FramePose& pose) {
  renderer::Frame frame = renderer::render_frame(world, sampling, {}, {}, pose);
  return {std::move(frame.bscope_W), std::move(frame.cscope_W_m3)};
}

inline void add(const std::vector<double>& from, double weight, std::vector<double>& to) {
  to.resize(from.size(), 0.0);
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += weight * from[i];
}

// Four of them together: cells of which only slivers show are still rough in one.
inline Powers converged_rays(const renderer::World& world, const renderer::FramePose& pose) {
  constexpr std::uint64_t kSeeds = 4;
  Powers mean;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Powers powers = render(world, renderer::reference_sampling(seed), pose);
    add(powers.bscope_W, 1.0 / kSeeds, mean.bscope_W);
    add(powers.cscope_W_m3, 1.0 / kSeeds, mean.cscope_W_m3);
  }
  return mean;
}

struct Difference {
  double bscope_rms = 0.0, cscope_rms = 0.0;  // grey, the mean noise in both pictures
  double mean_dB = 0.0;                       // over cells above the noise
};

inline double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

inline Difference difference(const sensors::Sensor& sensor, const Powers& found,
                             const Powers& expected) {
  const double noise_W = sensor.noise_power_W();
  const auto plus = [](std::vector<double> values, double constant) {
    for (double& value : values) value += constant;
    return values;
  };
  const auto bscope = [&](const Powers& powers) {
    return sensors::bscope_grey(sensor, plus(powers.bscope_W, noise_W));
  };
  const auto cscope = [&](const Powers& powers) {
    return sensors::cscope_grey(sensor,
                                plus(powers.cscope_W_m3, sensors::cscope_noise_W_m3(sensor)));
  };
  Difference result{rms(bscope(found), bscope(expected)), rms(cscope(found), cscope(expected)),
                    0.0};
  int lit = 0;
  for (std::size_t i = 0; i < expected.bscope_W.size(); ++i) {
    if (!(expected.bscope_W[i] > noise_W && found.bscope_W[i] > 0.0)) continue;
    result.mean_dB += 10.0 * std::log10(found.bscope_W[i] / expected.bscope_W[i]);
    ++lit;
  }
  REQUIRE(lit > static_cast<int>(expected.bscope_W.size() / 10));
  result.mean_dB /= lit;
  return result;
}

inline Difference against_rays(const renderer::World& world, const renderer::FramePose& pose,
                               double slices_per_column = 64.0) {
  return difference(world.sensor,
                    render(world, renderer::profile_sampling_for(slices_per_column), pose),
                    converged_rays(world, pose));
}

inline void check_same_picture(const Difference& difference) {
  CHECK(difference.bscope_rms < 0.5);
  CHECK(difference.cscope_rms < 0.5);
  CHECK(std::abs(difference.mean_dB) < 0.02);
}

}  // namespace fanbeam::tests
