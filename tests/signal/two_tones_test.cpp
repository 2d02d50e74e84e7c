// Two tones of one peak: found where they are, at the bound, and not where there is one.
#include "signal/detection/two_tones.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;

namespace {

constexpr int kRecordSamples = 500, kRecords = 12;

// Tones of amplitudes that turn from record to record, bent over the record.
ToneRecords records_of(const std::vector<std::pair<double, double>>& tones, double curvature_bins,
                       std::uint32_t trial) {
  ToneRecords records(kRecords, std::vector<std::complex<double>>(kRecordSamples));
  for (std::size_t c = 0; c < records.size(); ++c)
    for (std::size_t n = 0; n < records[c].size(); ++n) {
      const double t = (static_cast<double>(n) - 0.5 * (kRecordSamples - 1)) / kRecordSamples;
      for (std::size_t k = 0; k < tones.size(); ++k) {
        const double turns =
            tones[k].first * static_cast<double>(n) / kRecordSamples + 0.5 * curvature_bins * t * t;
        records[c][n] += std::polar(
            tones[k].second, 2.0 * kPi * turns + (k == 0 ? 0.4 : -0.3) * static_cast<double>(c) +
                                 1.7 * static_cast<double>(trial) * static_cast<double>(k + 1));
      }
      records[c][n] += tests::noise(1.0, c * 1000 + n, trial);
    }
  return records;
}

}  // namespace

TEST_CASE("A lone tone is not two, bent or not", "[detection][statistics]") {
  int two = 0;
  for (std::uint32_t trial = 0; trial < 200; ++trial)
    for (const double bend : {0.0, 0.2})
      two += two_tones(records_of({{100.3, trial % 2 == 0 ? 1.0 : 30.0}}, bend, trial), 100.3, bend,
                       1.0)
                 ? 1
                 : 0;
  CHECK(two == 0);
}

TEST_CASE("Two tones two thirds of a bin apart are found to a hundredth",
          "[detection][statistics]") {
  // 27 dB in a record. The bound of a tone alone is 0.0035 bins by 12 records; two this near share it.
  int found = 0;
  double squares = 0.0;
  constexpr int kTrials = 40;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const auto tones =
        two_tones(records_of({{100.0, 1.0}, {100.67, 0.7}}, 0.1, 300 + trial), 100.3, 0.1, 1.0);
    if (!tones) continue;
    ++found;
    squares += std::pow(tones->first.bin - 100.0, 2) + std::pow(tones->second.bin - 100.67, 2);
    CHECK(tones->first.power == Approx(kRecords).epsilon(0.1));
    CHECK(tones->second.power == Approx(0.49 * kRecords).epsilon(0.2));
  }
  CHECK(found == kTrials);
  CHECK(std::sqrt(squares / (2.0 * kTrials)) < 0.015);
}

TEST_CASE("Tones nearer than a third of a bin, or far weaker, are left as one", "[detection]") {
  CHECK_FALSE(two_tones(records_of({{100.0, 1.0}, {100.15, 1.0}}, 0.0, 7), 100.07, 0.0, 1.0));
  CHECK_FALSE(two_tones(records_of({{100.0, 10.0}, {101.0, 0.5}}, 0.0, 8), 100.0, 0.0, 1.0));
  CHECK_THROWS_AS(two_tones({}, 1.0, 0.0, 1.0), core::InputError);
  CHECK_THROWS_AS(two_tones(records_of({}, 0.0, 1), 1.0, 0.0, -1.0), core::InputError);
}
