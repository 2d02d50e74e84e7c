// The two ways to see a scene share this interface: power as a function of direction and range,
// before the azimuth beam, the receiver and the display.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sensors/antenna/antenna_frame.h"
#include "terrain/ray_scene.h"

namespace fanbeam::renderer {

// Received power per radian of azimuth for an antenna that points its azimuth beam everywhere at
// once (g_az = 1); elevation pattern, radar equation, NRCS and losses are in it.
struct FanSums {
  int sub_columns = 0;             // of the whole fan, the beam's margin on both sides included
  double first_azimuth_rad = 0.0;  // left edge of sub-column 0
  double step_rad = 0.0;
  int cells = 0;  // range cells, nearest first
  int rows = 0;   // elevation rows, highest first; 0 when no C-scope is asked for
  std::vector<double> range_W_per_rad;  // [sub-column][cell]
  std::vector<double>
      elevation_W_m3_per_rad;  // [sub-column][row]: power times R^3, summed over range

  std::uint64_t rays = 0;
  std::uint64_t slices = 0;
  std::uint64_t hits = 0;     // rays that met a surface, pieces of slices that are seen
  std::uint64_t blanked = 0;  // those of them nearer than the first range cell
};

// Points of which is asked whether the sensor sees them. A point on a surface is not hidden by that
// surface: what lies within kSightClearance_m before it does not count.
struct SightLines {
  std::vector<glm::dvec3> to_m;
  std::vector<std::uint8_t> clear;  // the answers: 1 where nothing is in the way
};

// A light stands 0.3 m above ground that is known to 0.1 m: nearer than this the ground does not
// hide it.
inline constexpr double kSightClearance_m = 1.0;

// Samples come in levels. Level 0 is what the sampling asks for; with each further one there are
// twice as many. A level of rays takes as many new ones as all levels before it together, evenly
// between those: the mean of all of them is again evenly sampled. A level of slices takes twice as
// many as the one before and replaces it: wedges that overlap would be worse than either.
struct CastPass {
  int level = 0;
  // Of fan_layout.h, rising; null for all. Sums of other groups keep what they hold, or are
  // anything where slices share sub-columns (a tilted antenna).
  const std::vector<std::uint32_t>* groups = nullptr;
};

class Caster {
 public:
  virtual ~Caster() = default;
  // Power for a sensor at `frame` from the samples of one level alone, and what it sees of `sight`.
  // Thread-safe; the result does not depend on the number of threads.
  virtual void cast(const sensors::AntennaFrame& frame, bool with_cscope, const CastPass& pass,
                    FanSums& sums, SightLines& sight) const = 0;
  void cast(const sensors::AntennaFrame& frame, bool with_cscope, FanSums& sums) const {
    SightLines none;
    cast(frame, with_cscope, CastPass{}, sums, none);
  }
};

// Answers `sight` with one ray each, for the points with `clear` at kAskRays; the others stay.
inline constexpr std::uint8_t kAskRays = 2;
void look_along_rays(const terrain::RayScene& surfaces, const glm::dvec3& sensor_m,
                     SightLines& sight);

}  // namespace fanbeam::renderer
