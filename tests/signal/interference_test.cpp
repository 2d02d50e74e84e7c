// Other radars' chirps: energy, duration and place of a crossing against closed forms; what mending them recovers.
#include "signal/synthesis/interference.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/angle/angle_peak.h"
#include "signal/fourier/fft.h"
#include "signal/receiver/mitigation.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/waveform/factories.h"
#include "tests/signal/reference_radar.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;
using tests::kRate_Hz;

namespace {

// 76 GHz, 250 MHz in 20 us, 400 samples a chirp.
Waveform chirps(int count) {
  ChirpSequenceParameters parameters;
  parameters.chirps = count;
  return chirp_sequence(parameters);
}

// Falls while the own chirp rises: crosses once a chirp, near its middle.
Interferer falling(double power_W) {
  Interferer one;
  one.start_frequency_Hz = 76.125e9;
  one.slope_Hz_per_s = -250e6 / 20e-6;
  one.duration_s = 19e-6;
  one.interval_s = 20e-6;
  one.start_s = 0.5e-6;
  one.range_m = 60.0;
  one.power_W = power_W;
  return one;
}

FloatCube heard(const Waveform& waveform, const Array& array, const Interferer& one) {
  FloatCube cube({400, static_cast<int>(waveform.segments.size()), array.channels()});
  add_interference(waveform, 0, array, {one}, cube);
  return cube;
}

double energy(const FloatCube& cube) {
  double sum = 0.0;
  for (const auto& value : cube.values) sum += static_cast<double>(std::norm(value));
  return sum;
}

}  // namespace

TEST_CASE("A crossing brings the power of the band over the difference of slopes",
          "[interference]") {
  const Waveform waveform = chirps(16);
  const FloatCube cube = heard(waveform, {}, falling(4e-12));
  // Per chirp P fs 2 corner (pi / 16) / sin(pi / 16) / |S - Q| samples' worth.
  const double share = (kPi / 16.0) / std::sin(kPi / 16.0);
  const double samples = kRate_Hz * 2.0 * 0.45 * kRate_Hz * share / 25e12;
  CHECK(energy(cube) == Approx(16.0 * 4e-12 * samples).epsilon(0.01));
  // Where both have the same frequency: f0 + S t = g0 - Q (t - T - tau) with tau of one way.
  const double delay_s = 60.0 / core::kSpeedOfLight_mps;
  const double at_s = (250e6 + 12.5e12 * (0.5e-6 + delay_s)) / 25e12;
  double sum = 0.0, weighted = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double power_W = static_cast<double>(std::norm(cube.at(0, 3, n)));
    sum += power_W;
    weighted += n / kRate_Hz * power_W;
  }
  CHECK(weighted / sum == Approx(at_s).epsilon(0.0).margin(0.5 / kRate_Hz));
  // Nothing of it elsewhere.
  CHECK(std::norm(cube.at(0, 3, 20)) == 0.0F);
}

TEST_CASE("An interferer of the same slope is a tone at its delay: a ghost", "[interference]") {
  const Waveform waveform = chirps(8);
  Interferer one = falling(1e-12);
  one.start_frequency_Hz = waveform.segments[0].start_frequency_Hz;
  one.start_s = 0.0;
  one.slope_Hz_per_s = waveform.segments[0].slope_Hz_per_s;
  const FloatCube cube = heard(waveform, {}, one);
  std::vector<std::complex<double>> chirp;
  for (int n = 100; n < 300; ++n) chirp.emplace_back(cube.at(0, 2, n));
  const auto lines = spectrum(chirp);
  std::size_t strongest = 0;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (std::norm(lines[k]) > std::norm(lines[strongest])) strongest = k;
  // One way alone: S R / c, half of what an echo from there would have.
  const double beat_Hz = 12.5e12 * 60.0 / core::kSpeedOfLight_mps;
  CHECK(static_cast<double>(strongest) * kRate_Hz / 200.0 ==
        Approx(beat_Hz).epsilon(0.0).margin(0.5 * kRate_Hz / 200.0));
}

TEST_CASE("The array hears where an interferer is, by its receivers alone", "[interference]") {
  const Waveform waveform = chirps(4);
  const double wavelength_m = waveform.wavelength_m();
  Array array = line_array(1, 8, 0.5 * wavelength_m);
  Interferer one = falling(1e-12);
  one.azimuth_rad = 0.3;
  const FloatCube cube = heard(waveform, array, one);
  std::vector<std::complex<double>> snapshot;
  for (int channel = 0; channel < 8; ++channel) snapshot.emplace_back(cube.at(channel, 1, 207));
  const AnglePeak peak = azimuth_peak(snapshot, virtual_elements_m(array), wavelength_m);
  CHECK(peak.azimuth_rad == Approx(0.3).epsilon(0.0).margin(2e-3));
  CHECK(peak.power == Approx(std::norm(snapshot[0])).epsilon(1e-3));
}

TEST_CASE("Power comes by Friis, and what makes no sense is refused", "[interference]") {
  // 35 dBm, 27 dB, 3.945 mm, 100 m: spreading loss 110.06 dB.
  const double power_W = interference_power_W(3.1623, 501.19, 3.944638e-3, 100.0);
  CHECK(10.0 * std::log10(power_W) == Approx(5.0 + 27.0 - 110.06).epsilon(0.0).margin(0.01));
  const Waveform waveform = chirps(4);
  FloatCube cube({400, 4, 1});
  const auto refused = [&](auto change) {
    Interferer one = falling(1.0);
    change(one);
    CHECK_THROWS_AS(add_interference(waveform, 0, {}, {one}, cube), core::InputError);
  };
  refused([](Interferer& one) { one.interval_s = 18e-6; });
  refused([](Interferer& one) { one.slope_Hz_per_s = std::nan(""); });
  refused([](Interferer& one) { one.range_m = 0.0; });
  refused([](Interferer& one) { one.power_W = -1.0; });
  refused([](Interferer& one) { one.duration_s = one.interval_s = 1e-14; });
  CHECK(energy(cube) == 0.0);
}

TEST_CASE("Mended samples give the echo and the floor back", "[interference]") {
  const Waveform waveform = chirps(16);
  ScatterPath path;
  path.range_m = 50.0;
  path.amplitude_sqrtW = 1e-3;
  const FloatCube clean = synthesise_beat(waveform, 0, {}, {path}, {});
  FloatCube crossed = clean;
  add_interference(waveform, 0, {}, {falling(1e-2)}, crossed);  // 40 dB over the echo
  const auto error = [&](const FloatCube& cube) {
    double sum = 0.0;
    for (std::size_t i = 0; i < cube.values.size(); ++i)
      sum += static_cast<double>(std::norm(cube.values[i] - clean.values[i]));
    return sum / energy(clean);
  };
  FloatCube zeroed = crossed, filled = crossed, untouched = clean;
  const std::size_t mended = mitigate(Mitigation::zero, kCrossedOverMedian, waveform, {}, zeroed);
  // 14.4 samples within the corner, and the low pass' slopes 26 dB down where 40 dB show above the
  // median: 2 x 0.45 fs x 10^(27/160) / |S - Q|, two more on either side.
  const double expected = kRate_Hz * 0.9 * kRate_Hz * std::pow(10.0, 27.0 / 160.0) / 25e12 + 4.0;
  CHECK(static_cast<double>(mended) / 16.0 == Approx(expected).epsilon(0.0).margin(2.0));
  mitigate(Mitigation::interpolate, kCrossedOverMedian, waveform, {}, filled);
  CHECK(mitigate(Mitigation::zero, kCrossedOverMedian, waveform, {}, untouched) == 0);
  CHECK(untouched.values == clean.values);
  CHECK(error(crossed) > 100.0);
  // Zeros take the samples' share of the echo; filling brings more than half of it back (63 %; between
  // lines, and with 60 turns instead of 20, 42 %).
  CHECK(error(zeroed) == Approx(static_cast<double>(mended) / (16.0 * 400.0)).epsilon(0.3));
  CHECK(error(filled) < 0.5 * error(zeroed));
  CHECK_THROWS_AS(mitigate(Mitigation::zero, 1.0, waveform, {}, filled), core::InputError);
}

TEST_CASE("Noise alone is mended in one sample of a million by one channel", "[interference]") {
  Waveform waveform = chirps(200);
  FloatCube cube({1000, 200, 1});
  tests::add_noise(cube, 1.0, 77);
  // 2e5 samples: 0.2 expected, each with four beside it.
  CHECK(mitigate(Mitigation::zero, kCrossedOverMedian, waveform, {}, cube) <= 15);
  // Real samples of noise are 20 times their median in 2.6 of a thousand, and are as much once a calibration has
  // turned their channel's phase.
  waveform.complex_baseband = false;
  for (const double phase_rad : {0.0, 0.6, kPi}) {
    FloatCube real = cube;
    const auto turn = static_cast<std::complex<float>>(std::polar(1.0, phase_rad));
    for (auto& value : real.values) value = turn * value.real();
    CHECK(mitigate(Mitigation::zero, kCrossedOverMedian, waveform, {}, real) <= 15);
  }
}
