// fanbeam live: a radar channel that a simulator, or a built-in flight, keeps moving.
#pragma once

#include <string>
#include <vector>

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct LiveOptions : SceneChoice {
  std::vector<std::string> from = {"circle"};  // live_wiring.h
  std::vector<std::string> to;
  std::string http = "8416";  // [ADDRESS:]PORT
  std::string token_file;
  std::string effects;
  double rate_Hz = 0.0;        // 0: the sensor's
  double rays_per_cell = 0.0;  // 0: as the rate allows, in lockstep the scene's
  bool lockstep = false;       // a frame for each pose
  std::string record, replay;  // files
  double speed = 1.0;          // of a replay
  double seconds = 0.0;        // 0: until stopped
  int frames = 0;              // 0: until stopped
  int threads = 0;
};

// Runs until it is stopped, which is its good end. Returns an exit code; throws InputError for bad
// input.
int fly(const LiveOptions& options, const CommonOptions& common);
CLI::App& add_live_command(CLI::App& program, LiveOptions& options, CommonOptions& common);

}  // namespace fanbeam::apps
