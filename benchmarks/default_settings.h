// What `fanbeam render` does by itself in a scene that has no ladder of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report_effort.h"
#include "benchmarks/view_clock.h"
#include "benchmarks/written_sequence.h"

namespace fanbeam::benchmarks {

struct DefaultFigures {
  std::string scene;
  std::optional<SequenceFigures> sequence;
  struct At {
    double distance_m = 0.0;
    FrameError error;  // at the default sampling, against a reference
  };
  std::vector<At> views;
};

// Nothing where the scene's data are not there.
std::optional<DefaultFigures> measure_defaults(const std::string& scene, const Effort& effort,
                                               int threads);

}  // namespace fanbeam::benchmarks
