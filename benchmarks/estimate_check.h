// Whether the error that a frame states of itself can be believed: on every shipped scene, against
// converged pictures.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/report_effort.h"

namespace fanbeam::benchmarks {

// One picture of a frame by one sampling: mean noise and every effect as the scene's plan has them
// (expected power, nothing drawn).
struct EstimateCase {
  std::string scene;
  int frame = 0;
  std::string sampling;  // "rays, default"
  std::string scope;     // "B-scope" or "C-scope"
  double estimate_grey = 0.0, true_grey = 0.0;

  // Errors that nobody sees: half a tenth of a grey level RMS.
  bool invisible() const { return estimate_grey < 0.05 && true_grey < 0.05; }
  bool within() const {
    const double ratio = true_grey / estimate_grey;
    return invisible() || (ratio > 1.0 / 1.5 && ratio < 1.5);
  }
};

// `effort.estimate_frames` frames spread over the approach of each scene whose data are there, by
// each caster that can show it: at default sampling and refined as for `--accuracy 0.5`.
std::vector<EstimateCase> check_estimates(const Effort& effort);

std::string estimates_markdown(const std::vector<EstimateCase>& cases);

// Those that somebody can see, those of them within the factor, and those that nobody sees, which
// are no evidence for estimates.
struct EstimateTally {
  int seen = 0, within = 0, unseen = 0;

  double share() const { return seen > 0 ? static_cast<double>(within) / seen : 1.0; }
  // "115 of 117 ...; the other 59 ..."
  std::string text() const;
};
EstimateTally tally_of(const std::vector<EstimateCase>& cases);

}  // namespace fanbeam::benchmarks
