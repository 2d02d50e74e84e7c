// Beats of two directions, from samples: where they are, and how wrong they say they may be.
#include "tracking/simulation/beat_waves.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/random.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/waveform/array.h"
#include "signal/waveform/factories.h"

using namespace fanbeam;
using namespace fanbeam::tracking;

namespace {

constexpr int kReceivers = 12;
constexpr double kRate_Hz = 500e3;
constexpr double kCell = 2.0 / kReceivers;  // c / (N d) in the sine, half a wavelength apart

// Both ramps 2 ms long, over 250 MHz.
signal::Waveform triangle() {
  signal::TriangleParameters parameters;
  parameters.frequency_Hz = 76.5e9;
  parameters.bandwidth_Hz = 250e6;
  parameters.ramp_s = 2e-3;
  parameters.sample_rate_Hz = kRate_Hz;
  return signal::triangle(parameters);
}

// A target, and where its beats and its direction are.
struct Echo {
  double range_m, speed_mps, azimuth_rad, amplitude;
};

struct Found {
  int two = 0;                       // runs that have two beats on both ramps
  double Hz2 = 0.0, azimuth2 = 0.0;  // errors over what is told, squared: means
  double worst_Hz = 0.0, worst_rad = 0.0;
};

// With phases of the targets at random.
Found found(const std::vector<Echo>& echoes, double signal_to_noise, int runs) {
  const signal::Waveform waveform = triangle();
  const signal::TriangleModel model = signal::triangle_model(waveform, 0);
  const double wavelength_m = waveform.wavelength_m();
  const signal::Array array = signal::line_array(1, kReceivers, 0.5 * wavelength_m);
  const double noise_W = 1000.0 * kReceivers / signal_to_noise;
  Found result;
  for (int run = 0; run < runs; ++run) {
    const core::RandomKey key{17, 0, static_cast<std::uint32_t>(run)};
    std::vector<signal::ScatterPath> paths;
    std::vector<signal::RangeSpeed> coarse;
    for (const Echo& echo : echoes) {
      const double turn = core::uniform_from(core::random_words(key, paths.size(), 10)[0]);
      signal::ScatterPath path;
      path.range_m = echo.range_m;
      path.radial_speed_mps = echo.speed_mps;
      path.azimuth_rad = echo.azimuth_rad;
      path.amplitude_sqrtW = std::polar(echo.amplitude, 2.0 * core::kPi * turn);
      paths.push_back(path);
      coarse.push_back({echo.range_m + 0.1, echo.speed_mps - 0.1});
    }
    signal::FloatCube samples = signal::synthesise_beat(waveform, 0, array, paths);
    signal::add_receiver_noise(array, {noise_W, true, key}, samples);
    const SampledBeats seen =
        triangle_beats(samples, model, kRate_Hz, noise_W, coarse,
                       {signal::virtual_elements_m(array), wavelength_m, 0.5, 0.8859 * kCell});
    if (seen.up.size() != 2 || seen.down.size() != 2) continue;
    ++result.two;
    for (const Echo& echo : echoes)
      for (const bool up : {true, false}) {
        const signal::BeatPair expected = predict(model, {echo.range_m, echo.speed_mps});
        const std::vector<Beat>& of_ramp = up ? seen.up : seen.down;
        const Beat& beat =
            *std::min_element(of_ramp.begin(), of_ramp.end(), [&](const Beat& a, const Beat& b) {
              return std::abs(a.azimuth_rad - echo.azimuth_rad) <
                     std::abs(b.azimuth_rad - echo.azimuth_rad);
            });
        const double Hz = beat.Hz - (up ? expected.up_Hz : expected.down_Hz);
        const double rad = beat.azimuth_rad - echo.azimuth_rad;
        result.Hz2 += std::pow(Hz / beat.sigma_Hz, 2);
        result.azimuth2 += std::pow(rad / beat.azimuth_sigma_rad, 2);
        result.worst_Hz = std::max(result.worst_Hz, std::abs(Hz));
        result.worst_rad = std::max(result.worst_rad, std::abs(rad));
        CHECK(beat.lone_wave);
      }
  }
  const double beats = 2.0 * static_cast<double>(echoes.size()) * std::max(1, result.two);
  result.Hz2 /= beats;
  result.azimuth2 /= beats;
  return result;
}

double right_of(double azimuth_rad, double cells) {
  return std::asin(std::sin(azimuth_rad) + cells * kCell);
}

}  // namespace

// One tone to any receiver; the array sees two, from a sixth of c / (N d) on. Mean squares of 240 values: 0.83 to 1.19 in
// 95 % of cases. Where frequencies were the one tone's they were off by what the two are apart; where the waves were taken
// for plane ones of one wavelength, frequencies by 6 and directions by 4 of their deviations.
TEST_CASE("Two targets of one range are two beats, as wrong as they tell", "[sampled]") {
  for (const double cells : {0.25, 0.5, 1.0, 2.0, 4.0})
    for (const double behind_m : {0.0, 0.08}) {
      CAPTURE(cells, behind_m);
      const Found seen = found(
          {{50.0, 0.0, -0.17, 1.0}, {50.0 + behind_m, 0.0, right_of(-0.17, cells), 0.7}}, 1e7, 60);
      CHECK(seen.two >= 59);
      CHECK(seen.Hz2 == Approx(1.0).epsilon(0.0).margin(0.3));
      CHECK(seen.azimuth2 == Approx(1.0).epsilon(0.0).margin(0.3));
    }
}

// Without noise to speak of, where the wave's curvature over the array is 0.004 rad: within 0.04 mm and 10 urad.
TEST_CASE("Beats of two directions are right, near the array and over the whole sweep",
          "[sampled]") {
  const Found seen =
      found({{20.0, 0.0, 0.5, 1.0}, {20.0, 0.0, right_of(0.5, -0.7), 0.8}}, 1e11, 10);
  CHECK(seen.two == 10);
  CHECK(seen.worst_Hz < 0.03);
  CHECK(seen.worst_rad < 1e-5);
}

// A car that goes 20 m/s slower than another one and whose beat is the same on one ramp, where it bends by 0.13 bins
// more; the two are two tones on the other.
TEST_CASE("Beats of two speeds that meet on one ramp are told apart by their directions",
          "[sampled]") {
  const signal::TriangleModel model = signal::triangle_model(triangle(), 0);
  const signal::BeatPair one = predict(model, {60.0, -10.0});
  // Up beats fall by the Doppler shift and grow by the range.
  const double per_m_Hz = predict(model, {61.0, -10.0}).up_Hz - one.up_Hz;
  const double other_m = 60.0 + (one.up_Hz - predict(model, {60.0, 10.0}).up_Hz) / per_m_Hz;
  const Found seen =
      found({{60.0, -10.0, 0.05, 1.0}, {other_m, 10.0, right_of(0.05, 0.5), 0.7}}, 1e7, 60);
  CHECK(seen.two == 60);
  CHECK(seen.Hz2 == Approx(1.0).epsilon(0.0).margin(0.3));
  CHECK(seen.azimuth2 == Approx(1.0).epsilon(0.0).margin(0.3));
}
