// Joint probabilistic data association: how likely each measurement belongs to each track, all
// tracks considered together, and how likely each track is there at all.
//
// A joint event gives every track at most one measurement and every measurement at most one track;
// its probability is proportional to the product over tracks of
//   Pd r g(t, j) / lambda   where track t has measurement j,
//   1 - Pd Pg r             where it has none,
// g the likelihood of the innovation, lambda the density of false measurements (in the units of g),
// r the probability that the target exists, Pd that it is detected, Pg that it falls into the gate.
// Sums over all events, exact: tracks are taken one after the other, forwards and backwards, with
// the used ones of those measurements as state that an earlier and a later track may want. Existence afterwards:
//   r' = sum_j beta_j + beta_0 (1 - Pd Pg) r / (1 - Pd Pg r) .
// With r = 1 this is JPDA, otherwise JIPDA.
// Source: T. E. Fortmann, Y. Bar-Shalom, M. Scheffe, IEEE J. Oceanic Eng. OE-8, 1983; D. Musicki,
// R. Evans, "Joint integrated probabilistic data association: JIPDA", IEEE Trans. AES-40, 2004.
// Inputs: likelihoods finite, 0 or more (0 outside the gate); probabilities in [0, 1]; lambda above
// 0. E-RANGE, E-NONFINITE otherwise. Cost: tracks 2^m m in each group of tracks that share
// measurements, m the most that are wanted by tracks on both sides of one, at most 16. Of a column of
// cars, each sharing measurements with its neighbours, m is 1 or 2.
// Where m is more than 16, in clutter so dense that gates hold dozens, each track of the group keeps its 16 likeliest
// measurements; where that is not enough, 8, 4, 2 or 1. `left_out` counts the others: 0 says that the sums are exact.
#pragma once

#include <vector>

#include "tracking/association/assignment.h"

namespace fanbeam::tracking {

struct JointSettings {
  double detection_probability = 0.98;
  double gate_probability = 0.999;
  double clutter_density = 1e-3;  // false measurements per unit of the likelihood's space
};

struct JointProbabilities {
  CostMatrix belongs;             // beta of track (row) and measurement (column)
  std::vector<double> missed;     // beta_0 of each track
  std::vector<double> existence;  // r'
  int left_out = 0;               // measurements of tracks
};

// `likelihood` of tracks (rows) and measurements (columns).
JointProbabilities joint_probabilities(const CostMatrix& likelihood,
                                       const std::vector<double>& existence,
                                       const JointSettings& settings);

}  // namespace fanbeam::tracking
