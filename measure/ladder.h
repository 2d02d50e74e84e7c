// Error and time of every way of sampling, over its ladder.
#pragma once

#include <vector>

#include "measure/bench.h"
#include "measure/frame_clock.h"

namespace fanbeam::measure {

struct LadderWork {
  Way way;
  double fineness;
  FrameClock clock;
  renderer::Sampling sampling{};  // of the two casters
};

// Steps of one frame, timed in turns.
std::vector<LadderStep> measure_steps(int frame, const renderer::GreyReference& reference,
                                      const std::vector<LadderWork>& works, int repetitions);

// `references` are of the bench's frames.
std::vector<LadderStep> measure_ladder(const CostBench& bench,
                                       const std::vector<renderer::GreyReference>& references);

// All frames as one: errors as RMS over the frames, times as their mean. In the order of the first
// frame.
std::vector<LadderStep> over_frames(const std::vector<LadderStep>& ladder);

// Milliseconds of `way` for an error of `rms`, and its error in `ms`: interpolated in a double
// logarithmic ladder. Nothing where the ladder does not reach; `error` picks the figure.
using PickError = double (*)(const renderer::FrameError&);
std::optional<double> ms_at_error(const std::vector<LadderStep>& ladder, Way way, double rms,
                                  PickError error);
std::optional<double> error_at_ms(const std::vector<LadderStep>& ladder, Way way, double ms,
                                  PickError error);

inline double bscope_with_noise(const renderer::FrameError& error) {
  return error.bscope.with_noise.rms;
}
inline double bscope_noise_free(const renderer::FrameError& error) {
  return error.bscope.noise_free.rms;
}
inline double cscope_with_noise(const renderer::FrameError& error) {
  return error.cscope.with_noise.rms;
}
inline double cscope_noise_free(const renderer::FrameError& error) {
  return error.cscope.noise_free.rms;
}

}  // namespace fanbeam::measure
