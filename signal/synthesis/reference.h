// Beat signals by the exact phase, one sine and cosine per sample, path and channel: the yardstick
// of every faster way. Any waveform, any array.
//
// A sample is the sum over paths of amplitude x exp(j phi), phi of beat_phase.h at the sample's own
// time. Real baseband: sqrt(2) times the real part, so that the mean square keeps the power.
// Pulsed: the echo is there while the delayed pulse is, without filter.
// Cost: about 50 ns of processor time per sample and path; runs on all threads. Sums in the order of the paths, so the
// same bits for any number of threads.
#pragma once

#include <vector>

#include "signal/cube.h"
#include "signal/scatter_path.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

DoubleCube reference_beat(const Waveform& waveform, int stage, const Array& array,
                          const std::vector<ScatterPath>& paths);

}  // namespace fanbeam::signal
