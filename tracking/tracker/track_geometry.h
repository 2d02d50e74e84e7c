// Tracks and measurements on the axes that a radar resolves: range, range rate, azimuth.
#pragma once

#include "tracking/filters/imm.h"

namespace fanbeam::tracking {

struct TrackerSettings;

struct PolarPlace {
  double range_m = 0.0, range_rate_mps = 0.0, azimuth_rad = 0.0;
};
PolarPlace polar(const ImmState& state);
PolarPlace polar(const RadarMeasurement& measurement);

// Closer than the resolution on all three axes.
bool unresolved(const PolarPlace& a, const PolarPlace& b, const TrackerSettings& settings);

// Position and velocity of a target seen once. Along the line of sight as uncertain as measured,
// across it R sigma_azimuth in position and `tangential_sigma_mps` about 0 in velocity. Errors as
// of observe().
Gaussian start_state(const RadarMeasurement& measurement, double tangential_sigma_mps);

struct WeightedImm {
  double weight = 0.0;
  ImmState state;
};

// Model by model, with weight x probability of the model; a model without any keeps the state of
// the first part.
ImmState moments(const std::vector<WeightedImm>& parts);

}  // namespace fanbeam::tracking
