// fanbeam live: a radar channel that a simulator, or a built-in flight, keeps moving.
#pragma once

#include "apps/common.h"
#include "apps/scene_choice.h"
#include "live/wiring/wiring.h"

namespace fanbeam::apps {

struct LiveOptions : SceneChoice, live::RunSettings {};

// Runs until it is stopped, which is its good end. Returns an exit code; throws InputError for bad
// input.
int fly(const LiveOptions& options, const CommonOptions& common);
CLI::App& add_live_command(CLI::App& program, LiveOptions& options);

}  // namespace fanbeam::apps
