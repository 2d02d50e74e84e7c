// A flight as fanbeam live is told it: poses from their sources to frames, frames to the page and their
// sinks, from scene to scene, until the end.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "live/hub.h"
#include "live/recording.h"
#include "live/wiring/wiring.h"
#include "session/session.h"

namespace fanbeam::live {

// What is left to whoever runs it.
struct RunCallbacks {
  // Opens a scene by the name or path that a command line takes. Throws InputError.
  std::function<std::unique_ptr<session::Session>(const std::string& scene)> open;
  // The page of a scene is there, of the port that it was given.
  std::function<void(const std::string& scene, std::uint16_t port)> page;
  // Gives for a scene what hears its state after each frame, and how many look at the page; it goes with
  // the scene.
  std::function<std::function<void(const Status&, int viewers)>()> status;
};

// Ends well when the thread's stop token asks, when the time or the frames are over and when a pipe's
// reader leaves. `wiring` is that of `settings`; `recording`, of settings.replay, null without one. Throws
// InputError: as `open`, sinks and Journal do, E-REF for a recording of another scene, E-IO for a port that
// is taken; core::Stopped for a stop while the scene is opened.
void run_live(const RunSettings& settings, const Wiring& wiring, const Recording* recording,
              const std::string& scene, const RunCallbacks& calls);

}  // namespace fanbeam::live
