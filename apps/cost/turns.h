// Times of things that are compared: measured in turns, so that all of them see the same machine.
#pragma once

#include <functional>
#include <vector>

#include "apps/cost/figures.h"

namespace fanbeam::apps {

// At most 5 rounds; in each, every work is done once to warm up (caches, threads and buffers are
// then as they are within a sequence) and then its share of `repetitions`, which count.
std::vector<MedianTime> time_in_turns(const std::vector<std::function<void()>>& works,
                                      int repetitions);

MedianTime median_of(std::vector<double> times_ms);

}  // namespace fanbeam::apps
