// Targets beyond what a waveform measures without ambiguity: counted and told, or refused.
//
// A range beyond the unambiguous one reads as its rest (complex samples: the beat folds by the
// sample rate; flat stages: the phase by a turn), a speed as its rest in [-vmax, vmax), and with
// real samples a negative beat reads as its amount.
// Of a uniform line at more than half a wavelength an azimuth reads as the rest of its sine within half a wavelength
// over the pitch (unambiguous_sine of array.h); of other arrays nothing is told of azimuths.
// Ranges and speeds are those at the clock's zero; what a target moves in one frame is neglected.
#pragma once

#include <vector>

#include "core/errors.h"
#include "signal/scatter_path.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

enum class FoldingPolicy { count, refuse };

struct StageFolding {
  int folded_ranges = 0;
  int folded_speeds = 0;
  int negative_beats = 0;  // of real samples
  double unambiguous_range_m = 0.0, farthest_m = 0.0, farthest_reads_m = 0.0;
  double unambiguous_speed_mps = 0.0, fastest_mps = 0.0, fastest_reads_mps = 0.0;
};

// One entry for every stage. With FoldingPolicy::refuse throws InputError (E-RANGE) with the
// figures of all stages that fold anything.
std::vector<StageFolding> count_folding(const Waveform& waveform,
                                        const std::vector<ScatterPath>& paths,
                                        FoldingPolicy policy = FoldingPolicy::count);

// The same of azimuths, as warnings: none or one.
std::vector<core::Problem> folded_azimuths(const Array& array, double wavelength_m,
                                           const std::vector<ScatterPath>& paths,
                                           FoldingPolicy policy = FoldingPolicy::count);

// "W-FOLDED ..." for everything counted, with figures; empty when nothing folds.
std::vector<core::Problem> folding_warnings(const std::vector<StageFolding>& stages);

}  // namespace fanbeam::signal
