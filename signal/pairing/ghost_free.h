// Pairings of beats that know more than one triangle, and so keep targets and drop ghosts.
//
// Two slopes: a pair of beats of the first triangle is a target if both beats that it predicts for
// the second are there, within a tolerance. Each pair is given the sum of its two misses; pairs are
// taken in the order of that sum, and one that explains no beat, of any of the four ramps, that is
// not explained already is dropped: it is what crossing pairs leave by chance.
//
// Two stages: a chirp sequence gives range and speed, coarse but without ambiguity. For each, the
// pair of fine beats is taken that fits best, (dR / sigma_R)^2 + (dv / sigma_v)^2 least; the fine
// pair gives the answer. A coarse target with no pair inside the gate has none.
//
// Sources: E. Hyun, W. Oh, J.-H. Lee, "Multi-target detection algorithm for FMCW radar", IEEE Radar
// Conf. 2012 (two stages, misses from 67 % to 3 %); H. Rohling, M.-M. Meinecke, CIE Radar 2001.
// Neglected: amplitudes, which would tell some pairs apart further.
#pragma once

#include <optional>
#include <vector>

#include "signal/pairing/triangle.h"

namespace fanbeam::signal {

struct TriangleBeats {
  TriangleModel model;
  std::vector<double> up_Hz, down_Hz;
};

struct TwoSlopesOptions {
  PairingLimits limits;
  // Of the second triangle's bins, for each of its ramps. Two beats that merged may be 0.6 bin away
  // from their common peak on both triangles.
  double tolerance_bins = 1.3;
};

// Range at the first triangle's turnaround.
std::vector<RangeSpeed> pair_two_slopes(const TriangleBeats& first, const TriangleBeats& second,
                                        const TwoSlopesOptions& options);

struct TwoStageOptions {
  double coarse_range_sigma_m = 0.3;
  double coarse_speed_sigma_mps = 0.3;
  double gate = 4.0;  // in standard deviations
};

// `coarse` at the triangle's turnaround. One answer for each entry, in order; nothing where no pair
// fits.
std::vector<std::optional<RangeSpeed>> refine_two_stage(const std::vector<RangeSpeed>& coarse,
                                                        const TriangleBeats& fine,
                                                        const TwoStageOptions& options);

}  // namespace fanbeam::signal
