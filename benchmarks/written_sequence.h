// A whole sequence through the program: frames rendered, display images written as PNG.
#pragma once

#include <optional>
#include <string>

#include "benchmarks/bench_scene.h"
#include "renderer/plan/caster_choice.h"

namespace fanbeam::benchmarks {

struct SequenceWish {
  renderer::CasterWish caster = renderer::CasterWish::automatic;
  std::string isa{};  // value of --isa; empty: what the machine has
};

struct SequenceFigures {
  std::string options;  // as on the command line
  std::string isa;
  std::string chosen;  // the caster it led to
  int frames = 0;
  double frame_ms = 0.0;              // median, pose to display images, while files are written
  double frames_per_s_written = 0.0;  // from the first pose to the last file
};

// `frames` frames around the view with `fanbeam render` at default sampling, into a temporary
// folder. Nothing, and a line on stderr, when the program does not lie beside this one or fails.
std::optional<SequenceFigures> measure_sequence(const View& view, const SequenceWish& wish,
                                                int frames, int threads);

}  // namespace fanbeam::benchmarks
