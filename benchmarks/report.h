// The measured figures as Markdown: docs/performance.md is this and nothing else.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure.h"
#include "benchmarks/sequence.h"

namespace fanbeam::benchmarks {

struct SceneFigures {
  const BenchScene* scene = nullptr;
  std::optional<SequenceFigures> sequence;
  std::vector<ViewFigures> views;
};

struct Report {
  int threads = 0;
  double load_before = 0.0;  // programs that ran in the minute before: other work spoils times
  std::vector<SceneFigures> scenes;
  std::vector<std::string> skipped;  // scenes without their data
};

std::string markdown(const Report& report);

// The section with the design's targets beside the figures.
std::string targets_markdown(const Report& report);

}  // namespace fanbeam::benchmarks
