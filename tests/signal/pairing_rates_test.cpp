// Rates of missed targets and ghosts on the level of frequencies: 400 frames of targets with range
// uniform in 10 to 200 m, speed uniform in +-60 m/s, 0.05 bin of noise on every beat, beats closer
// than 1.2 bins merged to their mean, a match within 1 m and 1 m/s.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "signal/pairing/ghost_free.h"
#include "signal/waveform/factories.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

constexpr int kFrames = 400;

struct Rates {
  double miss = 0.0, ghosts_per_frame = 0.0;
};

core::RandomKey key(int frame) { return {20240607, 901, static_cast<std::uint32_t>(frame)}; }

std::vector<RangeSpeed> targets_of(int frame, int count) {
  std::vector<RangeSpeed> targets;
  for (int i = 0; i < count; ++i) {
    const auto words = core::random_words(key(frame), static_cast<std::uint64_t>(i), 0);
    targets.push_back({10.0 + 190.0 * core::uniform_from(words[0]),
                       -60.0 + 120.0 * core::uniform_from(words[1])});
  }
  return targets;
}

std::vector<double> merged(std::vector<double> beats_Hz, double bin_Hz) {
  std::sort(beats_Hz.begin(), beats_Hz.end());
  std::vector<double> peaks_Hz;
  for (std::size_t i = 0; i < beats_Hz.size();) {
    std::size_t end = i + 1;
    double sum_Hz = beats_Hz[i];
    while (end < beats_Hz.size() && beats_Hz[end] - beats_Hz[end - 1] < 1.2 * bin_Hz)
      sum_Hz += beats_Hz[end++];
    peaks_Hz.push_back(sum_Hz / static_cast<double>(end - i));
    i = end;
  }
  return peaks_Hz;
}

// Beats of the targets, which were at these ranges at time 0.
TriangleBeats beats_of(const TriangleModel& model, const std::vector<RangeSpeed>& targets,
                       int frame, std::uint32_t draw) {
  TriangleBeats beats{model, {}, {}};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const RangeSpeed then{targets[i].range_m + targets[i].radial_speed_mps * model.turnaround_s,
                          targets[i].radial_speed_mps};
    const BeatPair pair = predict(model, then);
    const auto noise = core::normal_pair(key(frame), i, draw);
    beats.up_Hz.push_back(pair.up_Hz + 0.05 * model.bin_Hz() * noise[0]);
    beats.down_Hz.push_back(pair.down_Hz + 0.05 * model.bin_Hz() * noise[1]);
  }
  beats.up_Hz = merged(beats.up_Hz, model.bin_Hz());
  beats.down_Hz = merged(beats.down_Hz, model.bin_Hz());
  return beats;
}

bool match(const RangeSpeed& a, const RangeSpeed& b) {
  return std::abs(a.range_m - b.range_m) <= 1.0 &&
         std::abs(a.radial_speed_mps - b.radial_speed_mps) <= 1.0;
}

using PairingMethod = std::function<std::vector<RangeSpeed>(int, const std::vector<RangeSpeed>&)>;

Rates rates_of(int count, const PairingMethod& method) {
  int missed = 0, ghosts = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::vector<RangeSpeed> truth = targets_of(frame, count);
    const std::vector<RangeSpeed> found = method(frame, truth);
    for (const RangeSpeed& target : truth)
      missed += std::none_of(found.begin(), found.end(),
                             [&](const RangeSpeed& one) { return match(one, target); });
    for (const RangeSpeed& one : found)
      ghosts += std::none_of(truth.begin(), truth.end(),
                             [&](const RangeSpeed& target) { return match(one, target); });
  }
  return {static_cast<double>(missed) / (kFrames * count), static_cast<double>(ghosts) / kFrames};
}

const TriangleModel& short_triangle() {
  static const TriangleModel kModel = triangle_model(two_slopes({}), 0);
  return kModel;
}
const TriangleModel& long_triangle() {
  static const TriangleModel kModel = triangle_model(two_slopes({}), 1);
  return kModel;
}

PairingLimits limits() { return {0.0, 220.0, 65.0}; }

Rates sorted(int count) {
  return rates_of(count, [](int frame, const std::vector<RangeSpeed>& truth) {
    const TriangleBeats beats = beats_of(short_triangle(), truth, frame, 1);
    return pair_sorted(beats.model, beats.up_Hz, beats.down_Hz, limits());
  });
}

Rates all(int count) {
  return rates_of(count, [](int frame, const std::vector<RangeSpeed>& truth) {
    const TriangleBeats beats = beats_of(short_triangle(), truth, frame, 1);
    return pair_all(beats.model, beats.up_Hz, beats.down_Hz, limits());
  });
}

Rates slopes(int count) {
  return rates_of(count, [](int frame, const std::vector<RangeSpeed>& truth) {
    return pair_two_slopes(beats_of(short_triangle(), truth, frame, 1),
                           beats_of(long_triangle(), truth, frame, 2), {limits(), 1.3});
  });
}

Rates stages(int count) {
  return rates_of(count, [](int frame, const std::vector<RangeSpeed>& truth) {
    std::vector<RangeSpeed> coarse;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const auto noise = core::normal_pair(key(frame), i, 3);
      coarse.push_back(
          {truth[i].range_m + 0.3 * noise[0], truth[i].radial_speed_mps + 0.3 * noise[1]});
    }
    const auto refined = refine_two_stage(coarse, beats_of(short_triangle(), truth, frame, 1), {});
    std::vector<RangeSpeed> places;
    for (std::size_t i = 0; i < coarse.size(); ++i)
      places.push_back(refined[i].value_or(coarse[i]));
    return places;
  });
}

// A rate of misses counts 400 M targets; those of one frame depend on each other, which is taken as
// no more than halving their number: four standard deviations.
double tolerance(double rate, int targets) {
  return 4.0 * std::sqrt(rate * (1.0 - rate) / (0.5 * kFrames * targets));
}

struct PairingRow {
  int targets;
  double sorted_miss, sorted_ghosts, all_ghosts, slopes_miss, slopes_ghosts;
};
// Reference simulation; its ghosts depend on which solutions are taken at all, so only to 15 %.
constexpr PairingRow kPairingRows[] = {
    {2, 0.219, 0.43, 1.29, 0.0, 0.0},      {4, 0.560, 2.19, 7.91, 0.0, 0.008},
    {6, 0.660, 3.79, 18.8, 0.0025, 0.005}, {8, 0.750, 5.70, 34.8, 0.0025, 0.045},
    {10, 0.806, 7.50, 54.3, 0.006, 0.09},  {15, 0.872, 12.0, 124.0, 0.008, 0.40}};

}  // namespace

TEST_CASE("Sorted beats of a triangle lose most targets, all pairs none but make ghosts",
          "[pairing][statistics]") {
  for (const PairingRow& row : kPairingRows) {
    INFO(row.targets << " targets");
    const Rates by_order = sorted(row.targets);
    CHECK(by_order.miss ==
          Approx(row.sorted_miss).margin(tolerance(row.sorted_miss, row.targets)).epsilon(0.0));
    CHECK(by_order.ghosts_per_frame == Approx(row.sorted_ghosts).epsilon(0.15).margin(0.1));
    const Rates every = all(row.targets);
    CHECK(every.miss == 0.0);
    CHECK(every.ghosts_per_frame == Approx(row.all_ghosts).epsilon(0.15));
  }
}

TEST_CASE("A second slope keeps the targets and drops the ghosts", "[pairing][statistics]") {
  for (const PairingRow& row : kPairingRows) {
    INFO(row.targets << " targets");
    const Rates rates = slopes(row.targets);
    CHECK(rates.miss <= row.slopes_miss + tolerance(0.002, row.targets));
    CHECK(rates.ghosts_per_frame <= row.slopes_ghosts + 0.02);
  }
}

TEST_CASE("Two stages miss at most one target in two hundred, where sorting misses two in three",
          "[pairing][statistics]") {
  for (const PairingRow& row : kPairingRows) {
    INFO(row.targets << " targets");
    const Rates rates = stages(row.targets);
    CHECK(rates.miss <= 0.005);
    CHECK(rates.ghosts_per_frame <= 0.06);
  }
}
