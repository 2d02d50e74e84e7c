// The bound of tones that share records: closed forms, and errors of an estimator that reaches it.
#include "signal/detection/tone_bound.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/detection/two_tones.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;

namespace {

constexpr int kSamples = 500;

// `turns` at the middle sample.
Tone tone_at(double bin, double turns, double amplitude = 1.0) {
  const double to_first = bin * 0.5 * (kSamples - 1.0) / kSamples;
  return {bin, {std::polar(amplitude, 2.0 * kPi * (turns - to_first))}, amplitude * amplitude};
}

double ratio(double apart_bins, double turns) {
  const double alone = tone_bounds({tone_at(70.0, 0.0)}, kSamples, 1.0)[0].variance_bins2;
  const auto both =
      tone_bounds({tone_at(70.0, 0.0), tone_at(70.0 + apart_bins, turns)}, kSamples, 1.0);
  CHECK(both[0].variance_bins2 == Approx(both[1].variance_bins2).epsilon(1e-9));
  return both[0].variance_bins2 / alone;
}

}  // namespace

TEST_CASE("The bound of a lone tone and of two is the closed form", "[detection]") {
  // 6 / (4 pi^2 eta), eta = N A^2 / s2.
  const auto alone = tone_bounds({tone_at(70.0, 0.1, 3.0)}, kSamples, 0.5);
  CHECK(alone[0].variance_bins2 ==
        Approx(6.0 / (4.0 * kPi * kPi * kSamples * 9.0 / 0.5)).epsilon(1e-5));
  CHECK(alone[0].amplitude_noise_ratio == 1.0);
  // A bin apart, in quadrature: orthogonal, but for what their derivatives share.
  CHECK(ratio(1.0, 0.25) == Approx(1.0 / (1.0 - 3.0 / (kPi * kPi))).epsilon(1e-4));
  // In phase, worked out with matrices of the samples.
  CHECK(ratio(1.0, 0.0) == Approx(6.058).epsilon(1e-3));
  CHECK(ratio(0.5, 0.25) == Approx(5.834).epsilon(1e-3));
  CHECK(ratio(0.5, 0.0) == Approx(88.88).epsilon(1e-3));
  CHECK(ratio(5.5, 0.0) == Approx(1.031).epsilon(1e-3));
  CHECK(ratio(30.0, 0.0) == 1.0);
}

TEST_CASE("Places of tones are periodic, and what cannot be told has no bound", "[detection]") {
  const auto across = tone_bounds({tone_at(-0.3, 0.0), tone_at(0.4, 0.1)}, kSamples, 1.0);
  Tone wrapped = tone_at(-0.3, 0.0);
  wrapped.bin += kSamples;  // the same samples
  const auto same = tone_bounds({wrapped, tone_at(0.4, 0.1)}, kSamples, 1.0);
  CHECK(same[0].variance_bins2 == Approx(across[0].variance_bins2).epsilon(1e-9));
  CHECK(same[0].amplitude_noise_ratio == Approx(across[0].amplitude_noise_ratio).epsilon(1e-9));
  const auto twice = tone_bounds({tone_at(7.0, 0.0), tone_at(7.0, 0.2)}, kSamples, 1.0);
  CHECK(std::isinf(twice[0].variance_bins2));
  CHECK(std::isinf(tone_bounds({tone_at(7.0, 0.0, 0.0)}, kSamples, 1.0)[0].variance_bins2));
  // Several within a hundredth of a bin: the matrices are singular but for rounding.
  for (int i = 0; i < 200; ++i) {
    std::vector<Tone> crowd;
    for (int j = 0; j < 5; ++j)
      crowd.push_back(tone_at(50.0 + 1e-3 * ((i * 7 + j * 13) % 29), 0.13 * j * i, 1.0 + j));
    for (const ToneBound& bound : tone_bounds(crowd, kSamples, 1.0)) {
      CHECK(bound.variance_bins2 >= 0.0);
      CHECK(bound.amplitude_noise_ratio >= 0.0);
    }
  }
  // Neither hurts one that stands five bins away, nor does a tone of no power.
  const auto beside =
      tone_bounds({tone_at(7.0, 0.0), tone_at(7.0, 0.2), tone_at(12.0, 0.1)}, kSamples, 1.0);
  CHECK(beside[2].variance_bins2 <
        1.05 * tone_bounds({tone_at(12.0, 0.1)}, kSamples, 1.0)[0].variance_bins2);
  CHECK(tone_bounds({tone_at(9.0, 0.0), tone_at(7.0, 0.0, 0.0)}, kSamples, 1.0)[0].variance_bins2 ==
        tone_bounds({tone_at(9.0, 0.0)}, kSamples, 1.0)[0].variance_bins2);
  CHECK(tone_bounds({}, kSamples, 1.0).empty());
  Tone more = tone_at(3.0, 0.0);
  more.amplitudes.emplace_back(1.0, 0.0);
  CHECK_THROWS_AS(tone_bounds({tone_at(7.0, 0.0), more}, kSamples, 1.0), core::InputError);
  CHECK_THROWS_AS(tone_bounds({tone_at(std::nan(""), 0.0)}, kSamples, 1.0), core::InputError);
  CHECK_THROWS_AS(tone_bounds({}, 1, 1.0), core::InputError);
  CHECK_THROWS_AS(tone_bounds({}, kSamples, std::nan("")), core::InputError);
}

TEST_CASE("Amplitudes of tones at known places are those that made the records", "[detection]") {
  ToneRecords records(2, std::vector<std::complex<double>>(kSamples));
  const std::complex<double> made[2][2] = {{{1.0, 2.0}, {0.5, 0.0}}, {{-3.0, 0.1}, {0.0, 4.0}}};
  const double bins[] = {10.2, 10.7};
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t n = 0; n < kSamples; ++n)
      for (std::size_t k = 0; k < 2; ++k)
        records[c][n] +=
            made[k][c] * std::polar(1.0, 2.0 * kPi * bins[k] * static_cast<double>(n) / kSamples);
  const auto tones = tones_at(records, {bins[0], bins[1]});
  REQUIRE(tones.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t c = 0; c < 2; ++c) CHECK(std::abs(tones[k].amplitudes[c] - made[k][c]) < 1e-9);
    CHECK(tones[k].power == Approx(std::norm(made[k][0]) + std::norm(made[k][1])));
  }
}

// Places and amplitudes of both, over what is told.
TEST_CASE("Two tones of one peak err by their bound", "[detection][statistics]") {
  constexpr std::size_t kRecords = 12;
  constexpr int kTrials = 150;
  for (const double apart_bins : {0.6, 0.9, 1.4}) {
    double squares = 0.0, leaks = 0.0;
    for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
      ToneRecords records(kRecords, std::vector<std::complex<double>>(kSamples));
      for (std::size_t c = 0; c < kRecords; ++c)
        for (std::size_t n = 0; n < kSamples; ++n)
          for (std::size_t k = 0; k < 2; ++k) {
            const double turns = (100.0 + static_cast<double>(k) * apart_bins) *
                                     (static_cast<double>(n) - 0.5 * (kSamples - 1)) / kSamples +
                                 0.11 * static_cast<double>(c * k) + 0.31 * trial;
            records[c][n] += std::polar(10.0, 2.0 * kPi * turns);
            if (k == 0) records[c][n] += tests::noise(1.0, c * 1000 + n, 4000 + trial);
          }
      const auto found = two_tones(records, 100.0 + 0.5 * apart_bins, 0.0, 1.0);
      REQUIRE(found);
      const auto bounds = tone_bounds({found->first, found->second}, kSamples, 1.0);
      squares += std::pow(found->first.bin - 100.0, 2) / bounds[0].variance_bins2;
      // Of the first one's amplitudes, what points where the second's do.
      std::complex<double> leak = 0.0;
      for (std::size_t c = 0; c < kRecords; ++c) {
        const double middle = found->first.bin * 0.5 * (kSamples - 1.0) / kSamples;
        const auto at_middle = found->first.amplitudes[c] * std::polar(1.0, 2.0 * kPi * middle);
        const auto truth = std::polar(10.0, 2.0 * kPi * 0.31 * trial);
        leak += (at_middle - truth) *
                std::polar(1.0, -2.0 * kPi * (0.11 * static_cast<double>(c) + 0.31 * trial));
      }
      leaks += std::norm(leak) / kRecords * kSamples / bounds[0].amplitude_noise_ratio;
    }
    INFO(apart_bins << " bins: places " << squares / kTrials << ", amplitudes " << leaks / kTrials);
    CHECK(squares / kTrials == Approx(1.0).margin(0.35).epsilon(0.0));  // three deviations
    CHECK(leaks / kTrials <= 1.35);
    CHECK(leaks / kTrials >= 0.2);
  }
}
