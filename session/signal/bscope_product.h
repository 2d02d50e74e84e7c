// Product "bscope" of fanbeam fmcw: from a frame of a scene to its files.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "scenes/scene.h"
#include "session/signal/fmcw_settings.h"
#include "session/signal/signal_bscope.h"

namespace fanbeam::session {

// With the effects of the scene's plan that the signal level has, moving as the trajectory does.
SignalBscope fmcw_bscope(const scenes::Scene& scene, int frame, const FmcwSettings& options);

// DIR/bscope/00000.png, grey as the sensor's display shows it, and 00000.exr, watts: both laid out
// as those of fanbeam render, the farthest range on top. Throws InputError E-IO.
// Answers with the names of the files, relative to the folder.
std::set<std::string> write_bscope(const std::filesystem::path& folder,
                                   const sensors::Sensor& sensor, int frame,
                                   const SignalBscope& bscope);

}  // namespace fanbeam::session
