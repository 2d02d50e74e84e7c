// What a waveform reads for one target: its beats, and what of them folds.
#pragma once

#include <string>
#include <vector>

#include "core/errors.h"
#include "signal/scatter_path.h"
#include "signal/waveform/folding.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {

struct SlopeBeat {
  int stage;
  bool up;
  double beat_Hz;  // with the sign of complex samples, and not folded
};

struct WaveformTarget {
  signal::ScatterPath path;  // at the waveform's clock 0
  double doppler_shift_Hz = 0.0;
  std::vector<SlopeBeat> beats;  // one of every slope of every stage that has one
  std::vector<core::Problem> warnings;
};

// Throws InputError E-RANGE for a target that folds, where the policy is to refuse it.
WaveformTarget target_seen_by(const signal::Waveform& waveform, const signal::ScatterPath& path,
                              signal::FoldingPolicy policy);

// An object.
std::string waveform_target_json(const WaveformTarget& target);

}  // namespace fanbeam::session
