// fanbeam doctor: what makes a scene numerically delicate, and what to do about it.
#pragma once

#include <string>

#include "apps/common.h"
#include "apps/scene_choice.h"

namespace fanbeam::apps {

struct DoctorOptions : SceneChoice {
  std::string json;            // file to write as well; empty for none
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  bool measure = false;        // refine frames to see whether the accuracy can be reached
};

// Writes the findings as a table to standard output. Returns kExitDone when none is worse than
// delicate, else kExitCompareFailed; throws InputError for bad input.
int examine_scene(const DoctorOptions& options, const CommonOptions& common);
CLI::App& add_doctor_command(CLI::App& program, DoctorOptions& options);

}  // namespace fanbeam::apps
