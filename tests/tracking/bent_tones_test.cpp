// Beats of moving targets beside each other, without noise: what is left is what they do to each other.
#include "tracking/simulation/bent_tones.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "signal/fourier/window.h"
#include "tracking/simulation/ramp_tones.h"

using namespace fanbeam;
using namespace fanbeam::tracking;

namespace {

constexpr int kSamples = 1000;

BentTone tone_of(double bin, double amplitude, double curvature_bins, double phase_rad) {
  BentTone bent;
  bent.tone.bin = bin;
  for (int channel = 0; channel < 4; ++channel)
    bent.tone.amplitudes.push_back(std::polar(amplitude, phase_rad + 0.7 * channel));
  bent.curvature_bins = curvature_bins;
  return bent;
}

signal::ToneRecords records_of(const std::vector<BentTone>& tones) {
  signal::ToneRecords records(4, std::vector<std::complex<double>>(kSamples));
  for (const BentTone& bent : tones) add(bent, 1.0, records);
  return records;
}

double largest_error(const std::vector<BentTone>& found, const std::vector<BentTone>& truth) {
  double largest = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    largest = std::max(largest, bins_apart(found[i].tone.bin, truth[i].tone.bin, kSamples));
  return largest;
}

}  // namespace

// A car at a third of the range, so with ten times the amplitude, 4 bins away; 27 m/s bend a beat by 0.18
// bins in 2 ms.
TEST_CASE("Side lobes and bends of a strong beat do not pull a weak one", "[sampled]") {
  const auto window =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, kSamples);
  double pulled = 0.0, in_turn = 0.0, straight = 0.0;
  for (int i = 0; i < 8; ++i) {
    const std::vector<BentTone> truth{tone_of(100.3, 10.0, 0.18, 0.8 * i),
                                      tone_of(104.2, 1.0, 0.02, -0.5 * i)};
    const signal::ToneRecords records = records_of(truth);
    const double alone = signal::refined_tone(records, 104.2, window).bin;
    pulled = std::max(pulled, std::abs(alone - 104.2));
    in_turn = std::max(
        in_turn,
        largest_error(tones_in_turn(records, {{100.3, 0.18}, {104.2, 0.02}}, window), truth));
    straight = std::max(
        straight,
        largest_error(tones_in_turn(records, {{100.3, 0.0}, {104.2, 0.0}}, window), truth));
  }
  INFO("pulled " << pulled << ", in turn " << in_turn << ", bends left out " << straight);
  CHECK(pulled > 5e-3);  // 3 mm of 250 MHz
  CHECK(straight > 10.0 * in_turn);
  CHECK(in_turn < 2e-4);
}

TEST_CASE("Main lobes that overlap end where their beats are", "[sampled]") {
  const auto window =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, kSamples);
  const std::vector<BentTone> truth{tone_of(200.1, 1.0, 0.0, 0.2), tone_of(202.4, 0.8, 0.0, 1.9),
                                    tone_of(-0.4, 1.0, 0.0, 0.0), tone_of(997.2, 1.0, 0.0, 2.0)};
  const auto found = tones_in_turn(
      records_of(truth), {{200.0, 0.0}, {202.5, 0.0}, {999.5, 0.0}, {997.0, 0.0}}, window);
  CHECK(largest_error(found, truth) < 5e-4);
}

TEST_CASE("A peak without a tone of its own is lost, and changes no other", "[sampled]") {
  const std::vector<BentTone> truth{tone_of(300.0, 1.0, 0.0, 0.2), tone_of(330.0, 1.0, 0.0, 1.2)};
  const auto found =
      tones_in_turn(records_of(truth), {{300.0, 0.0}, {330.0, 0.0}, {302.5, 0.0}}, {});
  REQUIRE(found.size() == 3);
  CHECK_FALSE(found[0].lost);
  CHECK_FALSE(found[1].lost);
  CHECK((found[2].lost || found[2].tone.power < 1e-6));
  CHECK(largest_error({found[0], found[1]}, truth) < 1e-3);
  const auto window =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, kSamples);
  CHECK(tones_in_turn(records_of(truth), {{301.8, 0.0}}, window).front().lost);
}

// Of which the third is beside two that make one peak: it was 0.02 bins off.
TEST_CASE("What stands beside two beats of one peak is sought beside two", "[sampled]") {
  const auto window =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, kSamples);
  const std::vector<BentTone> truth{tone_of(100.0, 1.0, 0.0, 0.2), tone_of(101.2, 1.0, 0.0, 0.9),
                                    tone_of(103.9, 1.0, 0.0, 2.1), tone_of(120.0, 0.02, 0.0, 0.1)};
  const auto found = ramp_tones(records_of(truth), {100.5, 104.0, 120.0},
                                {{100.5, 0.0}, {103.9, 0.0}}, window, 1e-6, 1e-5);
  REQUIRE(found.size() == 4);
  CHECK(found[0].jointly);
  CHECK(found[1].jointly);
  CHECK(found[0].peak == found[1].peak);
  std::vector<BentTone> tones;
  for (const RampTone& one : found) tones.push_back(one.bent);
  std::sort(tones.begin(), tones.end(),
            [](const BentTone& a, const BentTone& b) { return a.tone.bin < b.tone.bin; });
  CHECK(largest_error(tones, truth) < 2e-3);
}

// A coarse place that stands for two; what its one tone leaves looks like more beats at the feet of the window.
TEST_CASE("Side lobes of two beats that were taken for one are none of their own", "[sampled]") {
  const auto window =
      signal::window_weights({.kind = signal::WindowKind::chebyshev, .level_dB = 60.0}, kSamples);
  const std::vector<BentTone> truth{tone_of(100.0, 1.0, 0.0, 0.2), tone_of(101.4, 1.0, 0.0, 0.9)};
  const auto found =
      ramp_tones(records_of(truth), {100.5, 105.0, 96.5}, {{100.6, 0.0}}, window, 1e-6, 1e-5);
  REQUIRE(found.size() == 2);
  CHECK(largest_error({found[0].bent, found[1].bent}, truth) < 1e-3);
}
