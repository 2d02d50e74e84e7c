// The waveform that the options of fanbeam waveform describe.
#pragma once

#include "apps/waveform_command.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::apps {

// Throws InputError with the option's name for one that the kind does not have.
signal::Waveform chosen_waveform(const WaveformOptions& options);

}  // namespace fanbeam::apps
