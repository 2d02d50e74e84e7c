// Time at equal error: how ways of sampling are compared with each other.
#pragma once

#include <optional>
#include <vector>

#include "benchmarks/measure.h"

namespace fanbeam::benchmarks {

// Noise-free B-scope errors at which they are.
inline constexpr double kEqualErrors[] = {2.6, 1.2};

// Milliseconds for a noise-free B-scope error of `rms`, interpolated in a double logarithmic
// ladder: nothing when no step is that good, the first step's time when that one is already.
std::optional<double> ms_at_error(const std::vector<SamplingFigures>& ladder, double rms);
std::optional<double> ms_at_error(const std::vector<NaiveFigures>& ladder, renderer::NaiveKind kind,
                                  double rms);

}  // namespace fanbeam::benchmarks
