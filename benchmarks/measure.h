// The figures of one view: error and time for each way of sampling.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/bare_pass.h"
#include "benchmarks/bench_scene.h"
#include "benchmarks/grey_error.h"
#include "benchmarks/naive.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::benchmarks {

inline constexpr double kBudget16Hz_ms = 62.5;
inline constexpr double kBudget90Hz_ms = 1000.0 / 90.0;

// One way to sample a frame, its price and what it buys.
struct SamplingFigures {
  renderer::Sampling sampling;
  double rays_per_cell = 0.0;  // per picture column, as `--rays-per-cell`
  double frame_ms = 0.0;
  std::uint64_t rays = 0;
  FrameError error;
};

struct NaiveFigures {
  NaiveKind kind = NaiveKind::plain;
  double frame_ms = 0.0;
  std::uint64_t rays = 0;
  FrameError error;
};

struct ViewFigures {
  View view;
  double reference_s = 0.0;
  std::uint64_t reference_rays = 0;
  // A second reference with another seed against the first.
  std::optional<FrameError> reference_error;
  std::vector<SamplingFigures> ladder;
  SamplingFigures at_16Hz, at_90Hz;  // the finest that fits, or the coarsest there is
  double one_thread_ms = 0.0;        // at_16Hz with one thread
  BarePass bare;                     // at_16Hz
  std::vector<NaiveFigures> naive;
  std::vector<SamplingFigures> splits;  // the same rays per cell, split otherwise; only where asked
};

// What need not be measured in every view.
struct Extras {
  bool second_reference = false;
  bool splits = false;
};

ViewFigures measure_view(const View& view, const Extras& extras);

// Noise-free B-scope errors at which ways of sampling are compared in time.
inline constexpr double kEqualErrors[] = {2.6, 1.2};

// Milliseconds for a noise-free B-scope error of `rms`, interpolated in a double logarithmic
// ladder: nothing when no step is that good, the first step's time when that one is already.
std::optional<double> ms_at_error(const std::vector<SamplingFigures>& ladder, double rms);
std::optional<double> ms_at_error(const std::vector<NaiveFigures>& ladder, NaiveKind kind,
                                  double rms);

}  // namespace fanbeam::benchmarks
