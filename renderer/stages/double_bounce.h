// Echoes that take two or three reflections: wall and ground, inner corners, mirrored ground.
//
// bounce_tracer.h says what one direction brings back; this stage chooses the directions and adds
// the echoes to the fan before the azimuth beam.
//
// How it samples: first one ray per picture column and every second elevation of the fan, only to
// see where mirrored rays meet anything at all; around these places one ray for every two
// sub-columns and every elevation (the reference: in each, jittered, in every pass). A corner seen
// over fewer than two elevations of the fan and narrower than a column may be missed, but not where
// samples of several levels are averaged: levels from 2 on search nothing and cast all. An echo
// lies in one range cell and in one sub-column, that of the mean of its first and last azimuth. It
// is not spread over the ranges up to its neighbours in elevation, as the casters' hits are: each
// has an azimuth of its own, and the range of a corner changes faster with that (measured:
// docs/performance-notes.md).
//
// Deterministic: each strip of sub-columns is one thread's; echoes that lie in another strip are
// added afterwards, in the order of the strips.
// Cost: a quarter of the frame's rays at the default sampling, plus the places that matter;
// docs/physics/double-bounce.md gives milliseconds.
#pragma once

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/sampling.h"
#include "renderer/stages/bounce_tracer.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class DoubleBounce {
 public:
  // `world` must outlive the stage.
  DoubleBounce(const World& world, const Sampling& sampling);

  // Adds to what the caster left in `sums`; thread-safe. Changes nothing in a world that does not
  // reflect. Samples of level 0 by default, or of a further one alone (CastPass).
  void add(const sensors::AntennaFrame& antenna, FanSums& sums, int level = 0) const;

 private:
  const World& world_;
  Sampling sampling_;
  ElevationFan fan_;
  BounceTracer tracer_;
};

}  // namespace fanbeam::renderer
