// What `fanbeam render` does by itself in a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report_effort.h"
#include "benchmarks/view_clock.h"
#include "benchmarks/written_sequence.h"

namespace fanbeam::benchmarks {

// One view at the default sampling of the scene's caster, against a reference.
struct DefaultError {
  double distance_m = 0.0;
  FrameError error;
};

struct DefaultFigures {
  std::string scene;
  std::optional<SequenceFigures> sequence;
  std::vector<DefaultError> views;
};

FrameError default_error(const View& view, const GreyReference& reference);

// Of a scene that has no ladder of its own. Nothing where its data are not there.
std::optional<DefaultFigures> measure_defaults(const std::string& scene, const Effort& effort,
                                               int threads);

}  // namespace fanbeam::benchmarks
