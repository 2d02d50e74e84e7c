// What planning and other conditions cost, what a plan saves, and that what it leaves out costs nothing.
#pragma once

#include <cstddef>

#include "benchmarks/bench_scene.h"
#include "benchmarks/report_effort.h"

namespace fanbeam::benchmarks {

struct PlanFigures {
  const BenchScene* scene = nullptr;
  double plan_ms = 0.0;  // facts and plan, median of a few builds
  // Another rain: plan, conditions, and the stages of the first frame; the site stands.
  double conditions_ms = 0.0;

  // A frame as planned, with every effect forced on that can occur in the scene, and with the
  // realisation (speckle, fluctuating targets) forced on besides.
  double planned_ms = 0.0, forced_ms = 0.0, forced_sample_ms = 0.0;
  std::size_t on_planned = 0, on_forced = 0, on_forced_sample = 0;  // effects that run

  // A frame of the scene with every effect switched off: with fog, rain, wet surfaces, side lobes
  // and a range window that could have effects, over a frame without them. Median of the ratios of
  // `frames` frames spread over the approach, rendered in turns.
  double off_over_absent = 0.0;
  int frames = 0;
  std::size_t only_possible = 0;  // effects that only the first of the two scenes could have

  double saved() const { return 1.0 - planned_ms / forced_ms; }
  double saved_sample() const { return 1.0 - planned_ms / forced_sample_ms; }
};

// At default sampling of rays. Builds the view's scene several times.
PlanFigures measure_plan(const View& view, const Effort& effort);

}  // namespace fanbeam::benchmarks
