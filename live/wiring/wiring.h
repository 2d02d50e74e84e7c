// What fanbeam live is told, and what that says together.
#pragma once

#include <string>
#include <vector>

#include "live/access.h"
#include "live/network.h"
#include "live/wiring/sinks.h"
#include "live/wiring/sources.h"

namespace fanbeam::live {

struct RunSettings {
  std::vector<std::string> from = {"circle"};  // as poses_from takes it
  std::vector<std::string> to{};               // as add_sink takes it
  std::string http = "8416";                   // [ADDRESS:]PORT
  std::string token_file{};
  std::string effects{};           // that the scene was opened with, as --effects tells them
  double rate_Hz = 0.0;            // 0: the sensor's
  double rays_per_cell = 0.0;      // 0: as the rate allows, in lockstep the scene's
  bool lockstep = false;           // a frame for each pose
  std::string record{}, replay{};  // files
  double speed = 1.0;              // of a replay
  double seconds = 0.0;            // 0: until stopped
  int frames = 0;                  // 0: until stopped
  int threads = 0;
};

struct Wiring {
  std::vector<PosesFrom> from;

  const PosesFrom& first() const { return from.front(); }
  FramesTo to;
  Endpoint page;
  Access access;  // to the page
};

inline constexpr const char* kTokenVariable = "FANBEAM_TOKEN";

// `token`: what kTokenVariable holds, which counts without a file; null or empty for nothing. `from` is that of the
// recording where there is one. Throws InputError with all that is wrong.
Wiring wiring_of(const RunSettings& settings, const char* token);

}  // namespace fanbeam::live
