// The waveform that the options of fanbeam waveform describe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "session/signal/waveform_settings.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {

// "continuous, pulsed, ..."
std::string waveform_kinds_text();

// Which of kWaveformNumbers has that option; InternalError where none has.
std::size_t waveform_number(std::string_view option);

// Throws InputError with the option's name, and its value in the option's unit, for one that the kind does not have or
// that does not go with the others.
signal::Waveform chosen_waveform(const WaveformSettings& options);

}  // namespace fanbeam::session
