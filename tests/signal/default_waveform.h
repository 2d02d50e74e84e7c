// A waveform of every kind, to loop over the kinds.
#pragma once

#include "core/errors.h"
#include "signal/waveform/factories.h"

namespace fanbeam::tests {

inline signal::Waveform default_waveform(signal::WaveformKind kind) {
  switch (kind) {
    case signal::WaveformKind::continuous:
      return signal::continuous({});
    case signal::WaveformKind::pulsed:
      return signal::pulsed({});
    case signal::WaveformKind::chirp_sequence:
      return signal::chirp_sequence({});
    case signal::WaveformKind::triangle:
      return signal::triangle({});
    case signal::WaveformKind::sinusoidal:
      return signal::sinusoidal({});
    case signal::WaveformKind::two_slopes:
      return signal::two_slopes({});
    case signal::WaveformKind::two_stage:
      return signal::two_stage({});
    case signal::WaveformKind::coded_triangle:
      return signal::coded_triangle({});
    case signal::WaveformKind::stepped:
      return signal::stepped({});
  }
  throw core::InternalError("waveform kind without defaults");
}

}  // namespace fanbeam::tests
