// The figures of one view: error and time for each way of sampling, of the whole picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/agreement.h"
#include "benchmarks/bare_pass.h"
#include "benchmarks/bench_scene.h"
#include "benchmarks/report_effort.h"
#include "benchmarks/view_clock.h"
#include "measure/ladder.h"
#include "renderer/casting/sampling.h"

namespace fanbeam::benchmarks {

inline constexpr double kBudget16Hz_ms = measure::kTime16Hz_ms;
inline constexpr double kBudget45Hz_ms = 1000.0 / 45.0;
inline constexpr double kBudget90Hz_ms = measure::kTime90Hz_ms;

using measure::LadderStep;
using measure::Way;

// Noise-free B-scope errors at which ways of sampling are compared.
inline constexpr double kEqualErrors_grey[] = {2.6, 1.2};

// The same frame with all threads of the run and with one, in turns.
struct ThreadFigures {
  double all_ms = 0.0;
  double one_ms = 0.0;

  double gain() const { return one_ms / all_ms; }
};

// One of the two casters in one view.
struct CasterFigures {
  std::vector<LadderStep> ladder;
  LadderStep at_16Hz, at_45Hz, at_90Hz;  // the finest that fits, or the coarsest there is
  ThreadFigures threads;                 // at_16Hz
};

struct ViewFigures {
  View view;
  double reference_s = 0.0;
  std::uint64_t reference_rays = 0;
  // A second reference with another seed against the first.
  std::optional<FrameError> reference_error;
  std::optional<AgreementFigures> reference_agreement;
  FrameError at_default;              // as `fanbeam render` has it by itself
  CasterFigures rays, slices;         // of the whole picture
  CasterFigures surfaces;             // slices, without effects: at 16 Hz and at 90 Hz alone
  AgreementFigures slices_agreement;  // converged ones with the reference
  BarePass bare;                      // rays.at_16Hz
  std::vector<LadderStep> naive;
  std::vector<LadderStep> splits;  // the same rays per cell, split otherwise; only where asked
};

// What need not be measured in every view.
struct Extras {
  bool second_reference = false;
  bool splits = false;
};

ViewFigures measure_view(const View& view, const Effort& effort, const Extras& extras);

}  // namespace fanbeam::benchmarks
