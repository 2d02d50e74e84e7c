// Echoes that take two or three reflections: wall and ground, inner corners, mirrored ground.
//
// bounce_tracer.h says what one direction brings back; this stage chooses the directions and adds
// the echoes to the fan before the azimuth beam.
//
// How it samples (bounce_strip.h): azimuths and elevations of its own, as many as the caster's
// samples ask for, and more where what they add differs by more than a part of a fixed power
// (bounce_limits.h), whatever the cell holds already. The fan begins at the lowest elevation of the
// beam: what is nearer than the first range cell shows nothing itself, but mirrors. A level has
// twice as many samples as the one before and replaces it: the mean of several coarse fans would
// keep what their intervals blur.
//
// Deterministic: each strip of sub-columns is one thread's; echoes that lie in another strip are
// added afterwards, in the order of the strips.
// Cost: docs/performance.md has milliseconds of whole pictures beside those of surfaces alone.
#pragma once

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/sampling.h"
#include "renderer/stages/bounce_strip.h"
#include "renderer/stages/bounce_tracer.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class DoubleBounce {
 public:
  // `world` must outlive the stage. `noise`: as in bounce_tracer.h.
  DoubleBounce(const World& world, const Sampling& sampling, bool noise);

  // Adds to what the caster left in `sums`; thread-safe. Changes nothing in a world that does not
  // reflect.
  void add(const sensors::AntennaFrame& antenna, FanSums& sums) const { add(antenna, 0, sums); }
  // The same with twice as many samples for each level. `alone`, unless null, receives
  // the same echoes and nothing else.
  void add(const sensors::AntennaFrame& antenna, int level, FanSums& sums,
           BounceFan* alone = nullptr) const;

 private:
  const World& world_;
  Sampling sampling_;  // of surfaces
  std::vector<double> shown_W_;
  BounceTracer tracer_;
};

}  // namespace fanbeam::renderer
