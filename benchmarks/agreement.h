// How well two converged pictures agree that were made in different ways.
#pragma once

#include <cstddef>
#include <string>

#include "benchmarks/bench_scene.h"
#include "benchmarks/off_cells.h"
#include "benchmarks/report_effort.h"
#include "benchmarks/view_clock.h"

namespace fanbeam::benchmarks {

struct PictureAgreement {
  PictureError error;  // grey levels
  double mean_dB =
      0.0;  // of noise-free power over the reference's, over lit cells with an echo in both
  // Cells more than kClearlyOff_grey apart, and all cells.
  std::size_t off_with_noise = 0, off_noise_free = 0, cells = 0;
};

struct FrameAgreement {
  PictureAgreement bscope, cscope;
};

FrameAgreement agreement_of(const sensors::Sensor& sensor, const FramePower& power,
                            const FramePower& reference);

// A line of the table of agreement.
struct AgreementFigures {
  std::string scene;
  double distance_m = 0.0;
  std::string what;
  FrameAgreement agreement;
  OffCells off;  // of slices; why they are apart
};

// Converged slices against the converged rays of `reference`; a frame of rays is cast where that is
// null.
AgreementFigures measure_agreement(const View& view, const Effort& effort,
                                   const FramePower* reference = nullptr);

}  // namespace fanbeam::benchmarks
