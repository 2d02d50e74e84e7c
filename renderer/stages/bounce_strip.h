// The bounces of a few picture columns' worth of azimuths.
//
// The fan is cut into intervals of elevation and blocks of azimuth, with one ray in each, at a
// place of its own. Where what the rays around it add differs by more than a part of a fixed power
// of their cell (shown_powers_W), an interval gets more. On planes through the facets that it met, a
// ray's echo is spread over the ranges and rows between the ends of what it stands for in elevation;
// in azimuth it counts where it is. Rays of a reference are jittered instead, and count where they
// were sent.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/radical_inverse.h"
#include "renderer/stages/bounce_tracer.h"

namespace fanbeam::renderer {

class BounceFan;

// How finely bounces are sampled.
struct BounceSampling {
  int azimuths = 1;            // blocks per strip
  double rays_per_cell = 1.0;  // range cells of ground, per block: without those for what differs
  // Of the powers BounceFrame::shown_W: where neighbours differ by more, an interval gets a ray for
  // each of it.
  double smallest_change = 0.0;
  double longest_reach_m = 0.0;  // of what one ray stands for, to either side of it
  terrain::Packing mirrored = terrain::Packing::alike;  // rays behind mirrors
  // Of a reference: see Sampling.
  int jittered_passes = 0;
  std::uint64_t seed = 0;
};

// What all strips of a fan share.
struct BounceFrame {
  const sensors::Sensor& sensor;
  const BounceSampling& sampling;
  const std::vector<double>& shown_W;  // bounce_limits.h
  const ElevationFan& fan;
  const BounceTracer& tracer;
  const sensors::AntennaFrame& antenna;
  PassPlace place;   // of its rays beside those of other levels
  int sub_columns;   // of a strip
  BounceFan* alone;  // unless null, gets what sums get
};

// What one echo gives to one sub-column, evenly between two ends of range and of elevation.
struct BounceShare {
  int sub_column = 0;
  double cells[2] = {}, power_W_per_rad = 0.0;
  double rows[2] = {}, power_W_m3_per_rad = 0.0;

  void deposit_in(FanSums& sums) const;
};

// Adds the echoes of strip number `strip` to `sums`, and to `foreign` what belongs to other strips.
// Returns the number of rays cast.
std::uint64_t cast_bounce_strip(const BounceFrame& frame, int strip, FanSums& sums,
                                std::vector<BounceShare>& foreign);

}  // namespace fanbeam::renderer
