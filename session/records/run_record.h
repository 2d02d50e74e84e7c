// run.json (what was computed: the same bytes for the same input) and timing.json (how long it
// took).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/effect_plan.h"
#include "renderer/accuracy/error_estimate.h"
#include "renderer/accuracy/refinement.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame.h"
#include "scenes/scene.h"
#include "session/sampling_choice.h"

namespace fanbeam::session {

struct FrameRecord {
  int index = 0;
  double time_s = 0.0;
  core::Pose pose;
  std::uint64_t rays = 0;
  std::uint64_t slices = 0;
  std::uint64_t blanked = 0;
  std::uint64_t unprojected = 0;
  std::vector<std::string> events;
  std::optional<renderer::ErrorEstimate> error;
  core::EffectSet left_out;     // effects of the plan that this frame did without
  std::set<std::string> files;  // its pictures and tables, relative to the folder
  double frame_ms = 0.0;
  bool resumed = false;  // taken over from an earlier run: no time was measured
};

struct RunRecord {
  SamplingChoice choice;
  renderer::Products wanted{};  // of each frame: refinement ends when all pictures are good enough
  std::string set;              // changed_conditions_json
  bool plan_per_frame = false;
  std::uint64_t seed = 0;
  std::string range_unit;           // asked for of the figure
  std::vector<FrameRecord> frames;  // by index
  std::set<std::string> films;      // beside the frames' files
  int threads = 0;
  double scene_build_s = 0.0;
  double wall_s = 0.0;  // frames, writing included
};

// "sample" when frames show one realisation, "mean" when they show the expected power.
std::string realisation_of(const core::EffectPlan& plan);

// "rays, 4 per range cell and column", "profile, 8 slices per column".
std::string caster_text(const renderer::Sampling& sampling);

std::string run_json(const scenes::Scene& scene, const RunRecord& record);
std::string timing_json(const RunRecord& record);

// A short text that changes when anything that shapes the pictures does: a setting of the files or
// of the session, the program, or a byte of a file that the scene names or that belongs to one. An
// estimate of errors counts as one. Stands in every picture.
std::string input_fingerprint(const scenes::Scene& scene, const RunRecord& record);

}  // namespace fanbeam::session
