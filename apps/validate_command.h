// fanbeam validate: every problem of a scene at once.
#pragma once

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct ValidateOptions : SceneChoice {};

// Returns an exit code; throws InputError for bad input.
int validate(const ValidateOptions& options, const CommonOptions& common);
CLI::App& add_validate_command(CLI::App& program, ValidateOptions& options);

}  // namespace fanbeam::apps
