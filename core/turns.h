// Times of things that are compared: measured in turns, so that all of them see the same machine.
#pragma once

#include <functional>
#include <vector>

namespace fanbeam::core {

// A median over repetitions, and how well it is known: the standard error of a median, estimated
// from the median absolute deviation (normal law: 1.4826 * 1.2533 * MAD / sqrt(n)).
struct MedianTime {
  double ms = 0.0;
  double error_ms = 0.0;
  int repetitions = 0;
};

// At most 5 rounds; in each, every work is done once to warm up (caches, threads and buffers are
// then as they are within a sequence) and then its share of `repetitions`, which count.
std::vector<MedianTime> time_in_turns(const std::vector<std::function<void()>>& works,
                                      int repetitions);

MedianTime median_of(std::vector<double> times_ms);

}  // namespace fanbeam::core
