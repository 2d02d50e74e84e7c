// The phase of one path in one channel of a uniform frame, as low polynomials of chirp and sample.
//
// In turns, m the chirp, k the sample counted from N / 2:
//   turns(m, k) = middle(m) + (per_sample + per_sample_chirp m) k + per_sample2 k^2
// `middle` goes through the exact phase at the first, middle and last chirp. What it leaves out is
// the change of the angle under which an element sees the path, and is bounded in `error_rad`.
#pragma once

#include "signal/synthesis/beat_phase.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/phase_run_private.h"

namespace fanbeam::signal {

struct PathRun {
  QuadraticTurns middle;
  double per_sample = 0.0, per_sample_chirp = 0.0, per_sample2 = 0.0;
  double error_rad = 0.0;
};

PathRun path_run(const Frame& frame, int channel, const ScatterPath& path);

// The same inside one chirp, of any linear segment: turns at sample n = 0, 1, ...
QuadraticTurns chirp_turns(const Frame& frame, const Segment& segment,
                           const PathGeometry& geometry);

// The geometry of a path as one channel sees it.
PathGeometry geometry_of(const Frame& frame, int channel, const ScatterPath& path);

}  // namespace fanbeam::signal
