// Tracks and measurements on the axes that a radar resolves: range, range rate, azimuth (0 without
// one).
#pragma once

#include "tracking/filters/imm.h"

namespace fanbeam::tracking {

struct PolarPlace {
  double range_m = 0.0, range_rate_mps = 0.0, azimuth_rad = 0.0;
};
PolarPlace polar(const ImmState& state);
PolarPlace polar(const RadarMeasurement& measurement);

struct Resolution {
  double range_m = 1.3, range_rate_mps = 1.2, azimuth_rad = 0.15;
};

// Closer than the resolution on all axes.
bool unresolved(const PolarPlace& a, const PolarPlace& b, const Resolution& resolution);
// On every axis between the two, or within the resolution of one of them.
bool between(const PolarPlace& place, const PolarPlace& a, const PolarPlace& b,
             const Resolution& resolution);

// Position and velocity of a target seen once. Along the line of sight as uncertain as measured,
// across it (on two axes) R sigma_azimuth in position and `tangential_sigma_mps` about 0 in
// velocity. Errors as of observe().
Gaussian start_state(const RadarMeasurement& measurement, int axes, double tangential_sigma_mps);

// Tells cheaply that a measurement lies outside a gate: its normalised innovation squared is at
// least that of range alone, and that of range rate alone. Never refuses one that lies inside.
class QuickGate {
 public:
  QuickGate(const ImmState& state, Measured measured, double gate);
  bool may_hold(const RadarMeasurement& measurement) const;

 private:
  struct Expected {
    double value[2], variance[2];
  };
  std::vector<Expected> models_;
  double gate_;
  std::size_t axes_;
};

struct WeightedImm {
  double weight = 0.0;
  ImmState state;
};

// Model by model, with weight x probability of the model; a model without any keeps the state of
// the first part.
ImmState moments(const std::vector<WeightedImm>& parts);

}  // namespace fanbeam::tracking
