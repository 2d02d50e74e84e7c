// Link budget, noise and quantisation of the reference radar.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "signal/receiver/link_budget.h"
#include "signal/receiver/mixer.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/beat_phase.h"
#include "tests/core/file_checks.h"
#include "tests/decibel.h"
#include "tests/signal/default_waveform.h"
#include "tests/signal/reference_radar.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using tests::code_of;
using tests::dB;
using tests::kWavelength_m;

namespace {

double ratio(double level_dB) { return std::pow(10.0, 0.1 * level_dB); }
double dBm(double power_W) { return dB(power_W / 1e-3); }

double mean_power(const DoubleCube& cube) {
  double sum = 0.0;
  for (const std::complex<double>& value : cube.values) sum += std::norm(value);
  return sum / static_cast<double>(cube.values.size());
}

ScatterPath at_rest(double range_m) { return {range_m, 0.0, 0.0, 0.0, {}}; }

}  // namespace

TEST_CASE("Link budget of the reference radar to 0.01 dB", "[receiver]") {
  const Link link{4e-3, ratio(32.0), ratio(27.0), kWavelength_m, 1.0};
  const double figure = ratio(4.5);
  CHECK(dBm(noise_density_W_per_Hz(figure)) == Approx(-169.4752).margin(1e-4).epsilon(0.0));
  const double ramps_s[] = {22.0 / 3.0 * 1e-6, 2e-3, 20e-3};
  const double noises_dBm[] = {-118.128, -142.485, -152.485};
  struct Row {
    double range_m, sigma_m2, power_dBm, snr_dB[3];
  };
  const Row rows[] = {{50, 10, -73.994, {44.134, 68.491, 78.491}},
                      {100, 10, -86.036, {32.093, 56.450, 66.450}},
                      {200, 10, -98.077, {20.051, 44.409, 54.409}},
                      {100, 1, -96.036, {22.093, 46.450, 56.450}},
                      {200, 1, -108.077, {10.051, 34.409, 44.409}}};
  for (const Row& row : rows) {
    const double power_W = received_power_W(link, row.range_m, row.sigma_m2);
    CHECK(dBm(power_W) == Approx(row.power_dBm).margin(0.01).epsilon(0.0));
    for (int i = 0; i < 3; ++i) {
      const double noise_W = integrated_noise_W(figure, ramps_s[i]);
      CHECK(dBm(noise_W) == Approx(noises_dBm[i]).margin(0.01).epsilon(0.0));
      CHECK(dB(power_W / noise_W) == Approx(row.snr_dB[i]).margin(0.01).epsilon(0.0));
    }
  }
  CHECK_THROWS_AS(received_power_W(link, 0.0, 1.0), core::InputError);
  CHECK(code_of([&] { received_power_W(link, std::nan(""), 1.0); }) == "E-NONFINITE");
  CHECK(code_of([&] { received_power_W(link, 10.0, std::nan("")); }) == "E-NONFINITE");
  CHECK_THROWS_AS(noise_density_W_per_Hz(0.5), core::InputError);
}

TEST_CASE("Receiver noise has the power of k T F fs, white in time", "[receiver]") {
  const double sample_W = noise_sample_W(ratio(4.5), 20e6);
  const Array array = line_array(1, 4, 2e-3);
  DoubleCube cube({400, 64, 4});
  add_receiver_noise(array, {sample_W, true, {11, 0, 3}}, cube);
  // 102400 samples: 0.1 dB is seven standard deviations.
  CHECK(dB(mean_power(cube) / sample_W) == Approx(0.0).margin(0.1).epsilon(0.0));
  // One bin of a ramp of 20 us: k T F / T.
  double bin_W = 0.0;
  std::complex<double> lag = 0.0;
  for (int channel = 0; channel < 4; ++channel)
    for (int chirp = 0; chirp < 64; ++chirp) {
      for (int bin = 0; bin < 20; ++bin) {
        std::complex<double> sum = 0.0;
        for (int n = 0; n < 400; ++n)
          sum += cube.at(channel, chirp, n) *
                 std::polar(1.0, -2.0 * core::kPi * ((bin * n) % 400) / 400.0);
        bin_W += std::norm(sum / 400.0) / (4 * 64 * 20);
      }
      for (int n = 1; n < 400; ++n)
        lag += cube.at(channel, chirp, n) * std::conj(cube.at(channel, chirp, n - 1)) /
               (4.0 * 64 * 399 * sample_W);
    }
  CHECK(dB(bin_W / integrated_noise_W(ratio(4.5), 20e-6)) == Approx(0.0).margin(0.25).epsilon(0.0));
  CHECK(std::abs(lag) < 4.0 / std::sqrt(4.0 * 64 * 399));
}

TEST_CASE("Real baseband gets half the noise, white, in the real part alone", "[receiver]") {
  DoubleCube cube({400, 64, 4});
  add_receiver_noise(line_array(1, 4, 2e-3), {2.0, false, {12, 0, 1}}, cube);
  // 102400 values of variance 1: four standard deviations. Were both numbers of a pair taken for
  // one sample, or one number for two, neighbours or samples 16 apart would be alike.
  const double count = 400.0 * 64 * 4;
  double variance = 0.0;
  double imaginary = 0.0;
  for (const std::complex<double>& value : cube.values) {
    variance += value.real() * value.real() / count;
    imaginary = std::max(imaginary, std::abs(value.imag()));
  }
  CHECK(imaginary == 0.0);
  CHECK(std::abs(variance - 1.0) < 4.0 * std::sqrt(2.0 / count));
  for (const std::size_t apart : {1U, 2U, 16U, 32U, 400U}) {
    double lag = 0.0;
    for (std::size_t i = apart; i < cube.values.size(); ++i)
      lag += cube.values[i].real() * cube.values[i - apart].real() / count;
    CHECK(std::abs(lag) < 4.0 / std::sqrt(count));
  }
}

// Orthogonal codes tell transmitters apart: each takes another part of what the receiver hears, noise included. One noise for
// all of a receiver's channels put it into beams as the transmitters' array factor, a third of them without any.
TEST_CASE("Every virtual channel has noise of its own, however transmitters are told apart",
          "[receiver]") {
  Array array = line_array(3, 4, 2e-3);
  const auto correlation = [&](int a, int b) {
    DoubleCube cube({256, 16, 12});
    add_receiver_noise(array, {1.0, true, {5, 0, 0}}, cube);
    std::complex<double> sum = 0.0;
    for (int chirp = 0; chirp < 16; ++chirp)
      for (int n = 0; n < 256; ++n)
        sum += cube.at(a, chirp, n) * std::conj(cube.at(b, chirp, n)) / (16.0 * 256);
    return std::abs(sum);
  };
  for (const Multiplex multiplex : {Multiplex::simultaneous, Multiplex::time_division}) {
    array.multiplex = multiplex;
    CHECK(correlation(0, 0) == Approx(1.0).epsilon(0.0).margin(0.07));
    CHECK(correlation(0, 4) < 0.07);
    CHECK(correlation(0, 1) < 0.07);
  }
}

TEST_CASE("Noise of nothing changes nothing, and one seed gives one noise", "[receiver]") {
  const Array array;
  DoubleCube cube({16, 4, 1});
  cube.at(0, 1, 2) = {1.0, 2.0};
  const std::vector<std::complex<double>> before = cube.values;
  add_receiver_noise(array, {0.0, true, {1, 0, 0}}, cube);
  CHECK(cube.values == before);
  DoubleCube again = cube;
  add_receiver_noise(array, {1.0, true, {1, 0, 7}}, cube);
  const core::ThreadLimit one(1);
  add_receiver_noise(array, {1.0, true, {1, 0, 7}}, again);
  CHECK(cube.values == again.values);
  add_receiver_noise(array, {1.0, true, {1, 0, 8}}, again);
  CHECK(cube.values != again.values);
  CHECK_THROWS_AS(add_receiver_noise(line_array(1, 4, 2e-3), {1.0, true, {}}, cube),
                  core::InputError);
}

TEST_CASE("The quantiser rounds to its steps, clips and counts", "[receiver]") {
  DoubleCube cube({4, 1, 1});
  cube.values = {{0.26, -0.24}, {0.99, -1.5}, {0.0, 0.124}, {-1.0, 0.75}};
  CHECK(quantise(Quantiser{3, 1.0}, cube) == 2);
  CHECK(cube.values ==
        std::vector<std::complex<double>>{{0.25, -0.25}, {0.75, -1.0}, {0.0, 0.0}, {-1.0, 0.75}});
  CHECK_THROWS_AS(quantise(Quantiser{0, 1.0}, cube), core::InputError);
  CHECK_THROWS_AS(quantise(Quantiser{8, 0.0}, cube), core::InputError);
}

TEST_CASE("Behind the low pass the mixer's product is the difference alone", "[receiver]") {
  // 100 km/h closing: images and sum at least 80 dB down. At 200 m the beat of the ramps lies above half the rate of their
  // complex samples. With a sweep of 40 MHz the beat of 1100 m takes the sum from 80 down to 65 MHz.
  ChirpSequenceParameters slow;
  slow.bandwidth_Hz = 40e6;
  for (const auto& [waveform, range_m] :
       {std::pair(tests::default_waveform(WaveformKind::chirp_sequence), 100.0),
        std::pair(tests::default_waveform(WaveformKind::chirp_sequence), 200.0),
        std::pair(tests::default_waveform(WaveformKind::triangle), 100.0),
        std::pair(chirp_sequence(slow), 1100.0)}) {
    ScatterPath echo;
    echo.range_m = range_m;
    echo.radial_speed_mps = -27.7778;
    const MixerTrace trace = mixer_trace(waveform, echo);
    const Segment segment = stage_segments(waveform, 0).front();
    const PathGeometry geometry(echo, {}, {});
    double worst = 0.0, product = 0.0;
    for (std::size_t n = 0; n < trace.beat.size(); ++n) {
      const double in_s = static_cast<double>(n) * trace.sample_s;
      const double delay_s = geometry.at(segment.start_s + in_s).length_m / core::kSpeedOfLight_mps;
      const double turns = beat_turns(waveform, segment, in_s, delay_s);
      worst = std::max(
          worst,
          std::abs(trace.beat[n] - 0.5 * std::cos(2.0 * core::kPi * (turns - std::floor(turns)))));
    }
    for (const double value : trace.product) product += value * value;
    INFO(name(waveform.kind) << " at " << range_m << " m");
    CHECK(worst < 0.5e-4);
    // The sum is there before: half of the product's power of 1/4.
    CHECK(product / static_cast<double>(trace.product.size()) == Approx(0.25).epsilon(0.01));
  }
  CHECK_THROWS_AS(mixer_trace(tests::default_waveform(WaveformKind::pulsed), at_rest(100.0)),
                  core::InputError);
  // Where the sweep is small beside the sample rate no low pass lies between beat and sum.
  ChirpSequenceParameters narrow;
  narrow.bandwidth_Hz = 0.99 * narrow.sample_rate_Hz;
  CHECK_THROWS_AS(mixer_trace(chirp_sequence(narrow), at_rest(100.0)), core::InputError);
  narrow.bandwidth_Hz = narrow.sample_rate_Hz;
  // A beat of 19.6 MHz, and the sum from 20.4 MHz on.
  CHECK_THROWS_AS(mixer_trace(chirp_sequence(narrow), at_rest(2940.0)), core::InputError);
  for (const double value : mixer_trace(chirp_sequence(narrow), at_rest(100.0)).beat)
    CHECK(std::abs(value) < 0.501);
}

TEST_CASE("A mixer's product of more samples than a number holds is refused, not wrapped around",
          "[receiver]") {
  // A ramp of 2 s sampled at 1 Hz: 9e9 samples of the product for one of the beat.
  ChirpSequenceParameters endless;
  endless.bandwidth_Hz = 1e9;
  endless.sample_rate_Hz = 1.0;
  endless.ramp_s = endless.interval_s = 2.0;
  endless.chirps = 1;
  CHECK(code_of([&] { mixer_trace(chirp_sequence(endless), at_rest(100.0)); }) == "E-LIMIT");
}
