// fanbeam plan: which effects a scene calls for, why, and what they cost.
#pragma once

#include <string>

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct PlanOptions : SceneChoice {
  std::string frames;  // as of fanbeam render; those looked at with per_frame and measure
  std::string effects;
  std::string products;        // that frames are wanted for; empty: B-scope and C-scope
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  int threads = 0;
  bool json = false;
  bool per_frame = false;
  bool measure = false;
  int repetitions = 20;
};

// Writes the table or JSON to standard output. Returns an exit code; throws InputError for bad
// input.
int explain_plan(const PlanOptions& options, const CommonOptions& common);
CLI::App& add_plan_command(CLI::App& program, PlanOptions& options);

}  // namespace fanbeam::apps
