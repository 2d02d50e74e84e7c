#include "signal/pairing/ghost_free.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::signal {
namespace {

struct Candidate {
  RangeSpeed target;
  double miss_bins = 0.0;
  std::size_t beats[4] = {};  // of the four ramps
};

std::size_t nearest(const std::vector<double>& beats_Hz, double to_Hz) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < beats_Hz.size(); ++i)
    if (std::abs(beats_Hz[i] - to_Hz) < std::abs(beats_Hz[best] - to_Hz)) best = i;
  return best;
}

std::vector<Candidate> candidates_of(const TriangleBeats& first, const TriangleBeats& second,
                                     const TwoSlopesOptions& options) {
  std::vector<Candidate> candidates;
  if (second.up_Hz.empty() || second.down_Hz.empty()) return candidates;
  const double between_s = second.model.turnaround_s - first.model.turnaround_s;
  const double bin_Hz = second.model.bin_Hz();
  for (std::size_t up = 0; up < first.up_Hz.size(); ++up)
    for (std::size_t down = 0; down < first.down_Hz.size(); ++down) {
      const RangeSpeed target = solve(first.model, {first.up_Hz[up], first.down_Hz[down]});
      if (!options.limits.allow(target)) continue;
      const RangeSpeed later{target.range_m + target.radial_speed_mps * between_s,
                             target.radial_speed_mps};
      const BeatPair expected = predict(second.model, later);
      const std::size_t up2 = nearest(second.up_Hz, expected.up_Hz);
      const std::size_t down2 = nearest(second.down_Hz, expected.down_Hz);
      const double up_miss = std::abs(second.up_Hz[up2] - expected.up_Hz) / bin_Hz;
      const double down_miss = std::abs(second.down_Hz[down2] - expected.down_Hz) / bin_Hz;
      if (std::max(up_miss, down_miss) > options.tolerance_bins) continue;
      candidates.push_back({target, up_miss + down_miss, {up, down, up2, down2}});
    }
  return candidates;
}

}  // namespace

std::vector<RangeSpeed> pair_two_slopes(const TriangleBeats& first, const TriangleBeats& second,
                                        const TwoSlopesOptions& options) {
  std::vector<Candidate> candidates = candidates_of(first, second, options);
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.miss_bins < b.miss_bins; });
  std::vector<bool> explained[4] = {
      std::vector<bool>(first.up_Hz.size()), std::vector<bool>(first.down_Hz.size()),
      std::vector<bool>(second.up_Hz.size()), std::vector<bool>(second.down_Hz.size())};
  std::vector<RangeSpeed> targets;
  for (const Candidate& candidate : candidates) {
    bool is_new = false;
    for (std::size_t ramp = 0; ramp < 4; ++ramp)
      is_new = is_new || !explained[ramp][candidate.beats[ramp]];
    if (!is_new) continue;
    for (std::size_t ramp = 0; ramp < 4; ++ramp) explained[ramp][candidate.beats[ramp]] = true;
    targets.push_back(candidate.target);
  }
  return targets;
}

std::vector<std::optional<RangeSpeed>> refine_two_stage(const std::vector<RangeSpeed>& coarse,
                                                        const TriangleBeats& fine,
                                                        const TwoStageOptions& options) {
  std::vector<std::optional<RangeSpeed>> refined;
  for (const RangeSpeed& target : coarse) {
    std::optional<RangeSpeed> best;
    double least = options.gate * options.gate;
    for (const double up_Hz : fine.up_Hz)
      for (const double down_Hz : fine.down_Hz) {
        const RangeSpeed pair = solve(fine.model, {up_Hz, down_Hz});
        const double misfit =
            std::pow((pair.range_m - target.range_m) / options.coarse_range_sigma_m, 2) +
            std::pow(
                (pair.radial_speed_mps - target.radial_speed_mps) / options.coarse_speed_sigma_mps,
                2);
        if (misfit < least) {
          least = misfit;
          best = pair;
        }
      }
    refined.push_back(best);
  }
  return refined;
}

}  // namespace fanbeam::signal
