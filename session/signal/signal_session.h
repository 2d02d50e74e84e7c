// Scenes as signals see them, planned otherwise than for pictures: samples are a realisation, in which
// targets fluctuate; and maps and detections stand tens of dB below the black of a display, on noise
// that integration has lowered, so that every effect with any influence on the echoes runs.
#pragma once

#include <memory>

#include "session/session.h"

namespace fanbeam::session {

// How a session for signals alone is opened.
Setup signal_setup(scenes::BuildOptions build = {});

// What a session for pictures holds now, planned anew for signals: milliseconds.
std::shared_ptr<const scenes::Scene> planned_for_signals(
    std::shared_ptr<const scenes::Scene> scene);

}  // namespace fanbeam::session
