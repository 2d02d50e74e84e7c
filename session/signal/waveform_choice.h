// The waveform that the options of fanbeam waveform describe.
#pragma once

#include <string>

#include "session/signal/waveform_settings.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {

// "continuous, pulsed, ..."
std::string waveform_kinds_text();

// Throws InputError with the option's name, and its value in the option's unit, for one that the kind does not have or
// that does not go with the others.
signal::Waveform chosen_waveform(const WaveformSettings& options);

}  // namespace fanbeam::session
