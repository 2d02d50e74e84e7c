// How much `fanbeam cost` spends on each figure, and how long that will take.
#pragma once

#include <cstdint>
#include <vector>

#include "measure/figures.h"
#include "renderer/accuracy/naive_caster.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::measure {

struct Effort {
  int repetitions = 20;
  int reference_passes = 16;  // times 16 sub-columns: azimuths per column
  // Ladders, coarsest first.
  std::vector<double> rays;                       // per range cell and column
  std::vector<double> slices;                     // per column
  std::vector<double> plain_rays, dithered_rays;  // of the naive renderers, as `rays`
  std::vector<int> looks;                         // at signal level
  bool quick = false;  // figures show that everything runs, and little more

  const std::vector<double>& ladder(Way way) const;
  renderer::Sampling reference(std::uint64_t seed) const;
};

Effort full_effort();
Effort quick_effort();

// Sampling of the two casters for a step of their ladder.
renderer::Sampling sampling_of(Way way, double fineness);
// Of the two others.
renderer::NaiveKind naive_kind(Way way);

// Times of a few frames of the scene, from which all others follow roughly: enough to say whether a
// run takes one minute or ten.
struct Pace {
  double build_s = 0.0;
  double frame_ms = 0.0;   // rays at default sampling
  double slices_ms = 0.0;  // the same; 0 where there are none
  double naive_ms = 0.0;   // one naive ray per range cell and column

  double step_ms(Way way, double fineness) const;
  double reference_s(const Effort& effort) const;
  double ladder_s(const Effort& effort) const;  // of one frame, references apart
};

}  // namespace fanbeam::measure
