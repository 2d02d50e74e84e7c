#include "core/turns.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fanbeam::core {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostRounds = 5;

double middle_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

}  // namespace

MedianTime median_of(std::vector<double> times_ms) {
  if (times_ms.empty()) return {};
  MedianTime time;
  time.repetitions = static_cast<int>(times_ms.size());
  time.ms = middle_of(times_ms);
  for (double& value : times_ms) value = std::abs(value - time.ms);
  time.error_ms = 1.4826 * 1.2533 * middle_of(times_ms) / std::sqrt(time.repetitions);
  return time;
}

std::vector<MedianTime> time_in_turns(const std::vector<std::function<void()>>& works,
                                      int repetitions) {
  const int rounds = std::min(kMostRounds, repetitions);
  std::vector<std::vector<double>> times_ms(works.size());
  for (int round = 0; round < rounds; ++round) {
    const int from = repetitions * round / rounds, to = repetitions * (round + 1) / rounds;
    for (std::size_t i = 0; i < works.size(); ++i) {
      works[i]();
      for (int k = from; k < to; ++k) {
        const Clock::time_point begin = Clock::now();
        works[i]();
        times_ms[i].push_back(
            std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
      }
    }
  }
  std::vector<MedianTime> medians;
  for (const std::vector<double>& times : times_ms) medians.push_back(median_of(times));
  return medians;
}

}  // namespace fanbeam::core
