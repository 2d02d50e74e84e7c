// Azimuth slices instead of rays: the scene is cut along vertical half-planes, each is swept once
// for exact visibility, and every visible piece is deposited in closed form.
//
// What it sees: the triangulated ground with its land cover and painted surfaces, and the solid
// prisms of World::solids. Inside a slice visibility and geometry are exact for plane facets
// (slice_sweep.h, slice_power.h); pattern, NRCS and loss are those in the middle of each piece,
// which spans at most 2 mrad of elevation. A slice stands for the wedge around it. Buildings are
// clipped to the wedge: walls and shadows count with their true widths, and oblique walls spread
// over their ranges (wedge_strips.h). The error left is that of the ground's azimuths between slices
// and of where in its sub-column a thing stands: closed forms within 1e-9 for constant gamma and an
// even pattern, 0.01 dB for HiVision's; converged slices against converged rays in
// docs/performance.md.
// What a vertical cut cannot describe (models, prisms with air under them) is left to rays: the
// sub-columns that such a thing stands in are cast by a RayCaster. Half-planes of other
// azimuths cannot meet it, so both see each other rightly. With a tilted antenna or a cone scan
// sub-columns are no half-planes; scenes with such things then go to rays alone.
//
// Lines of sight are tested against the horizon of the strip of a wedge that they lie in, at their
// own distance and height: up to half a wedge beside their true azimuth, as far as the ground goes.
//
// Neglected: what ray_caster.h neglects. A slice is a half-plane through the local vertical; an
// antenna tilted by less than 1 mrad counts as level.
#pragma once

#include <memory>

#include "renderer/casting/caster.h"
#include "renderer/casting/profile/slice_scene.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class ProfileCaster : public Caster {
 public:
  // `world` must outlive the caster and have a ground, its fan at most 150 deg
  // (plan/caster_choice.h).
  ProfileCaster(const World& world, const Sampling& sampling);

  using Caster::cast;
  void cast(const sensors::AntennaFrame& frame, bool with_cscope, const CastPass& pass,
            FanSums& sums, SightLines& sight) const override;

 private:
  int slices_per_sub_column(int level) const { return sampling_.slices_per_sub_column << level; }
  void cast_level(const sensors::AntennaFrame& antenna, bool with_cscope, const CastPass& pass,
                  FanSums& sums, SightLines& sight) const;
  void cast_across(const sensors::AntennaFrame& antenna, int per_sub_column, FanSums& sums,
                   SightLines& sight) const;

  const World& world_;
  Sampling sampling_;
  SliceScene scene_;
  std::unique_ptr<RayCaster> rays_;  // in worlds with things that slices cannot show
};

}  // namespace fanbeam::renderer
