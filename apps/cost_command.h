// fanbeam cost: what accuracy and effects cost in time on a scene, measured.
#pragma once

#include <string>
#include <vector>

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct CostOptions : SceneChoice {
  std::string output;  // default out/<scene name>-cost
  std::string frames;  // as RenderOptions::frames; empty: two, spread over the trajectory
  std::vector<std::string> parts = {"ladder", "effects", "numerics", "levels"};
  std::string caster;   // of the effects' frames; empty: the scene's
  int repetitions = 0;  // 0: 20, or 3 with `quick`
  int threads = 0;
  bool quick = false;
};

// Writes ladder.csv, equal_error.csv, effects.csv, numerics.csv, levels.csv, plots as SVG and PNG, and cost.md.
// Returns an exit code; throws InputError for bad input.
int cost(const CostOptions& options, const CommonOptions& common);
CLI::App& add_cost_command(CLI::App& program, CostOptions& options);

}  // namespace fanbeam::apps
