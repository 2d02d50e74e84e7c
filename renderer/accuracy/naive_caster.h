// The renderer people write first, as a yardstick: uniform elevation angles, one ray at a time,
// each hit put into the one cell it falls in. Radar equation, tables and every stage after the cast
// are the project's own (it is a caster for FrameRenderer), double bounces sampled as beside as many
// rays of RayCaster, so that only the sampling of surfaces differs. The rays are RayScene's checked
// single ones.
//
//   plain     one azimuth per picture column, its centre
//   dithered  four sub-columns per column, every ray at its own azimuth inside its sub-column
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

enum class NaiveKind { plain, dithered };

// What FrameRenderer has to be told beside the caster itself: its sub-columns per column, and the
// rays per range cell and column, of which double bounces have their share.
Sampling naive_sampling(NaiveKind kind, double rays_per_cell = 1.0);

// Elevations of the lowest and highest ray that RayCaster sends at default sampling: where uniform
// angles lose the least. Both 0 when nothing can be seen.
struct ElevationSpan {
  double lowest_rad = 0.0;
  double highest_rad = 0.0;
};
ElevationSpan elevation_span(const World& world, const sensors::AntennaFrame& antenna);

class NaiveCaster : public Caster {
 public:
  // About `rays` rays per frame, over `span` in elevation; at least one per sub-column. `world`
  // must outlive the caster.
  NaiveCaster(const World& world, NaiveKind kind, double rays, const ElevationSpan& span);

  using Caster::cast;
  // Knows level 0 of whole fans alone; anything else is an InternalError.
  void cast(const sensors::AntennaFrame& antenna, bool with_cscope, const CastPass& pass,
            FanSums& sums, SightLines& sight) const override;

 private:
  struct Turn {
    double cosine, sine;
  };
  struct Frame;
  struct Counts {
    std::uint64_t hits = 0, blanked = 0;
  };
  Counts cast_sub_column(const Frame& frame, std::size_t sub_column, FanSums& sums) const;
  void cast_ray(const Frame& frame, const Turn& azimuth, std::size_t elevation,
                double* range_W_per_rad, double* elevation_W_m3_per_rad, Counts& counts) const;

  const World& world_;
  NaiveKind kind_;
  double step_rad_ = 0.0;  // between elevations
  std::vector<double> elevations_rad_;
  std::vector<Turn> elevation_turns_;
  sensors::TwoWayTable elevation_gain_;
};

}  // namespace fanbeam::renderer
