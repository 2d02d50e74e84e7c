// Rays through Embree: any geometry, the reference.
//
// What it computes: for each sub-column of azimuth the received power per radian (caster.h). A ray
// at elevation e that hits a facet at slant range R under the local grazing angle psi stands for
// the solid angle J de daz around it, so
//     dP = K g_el(e)^2 [sigma0(psi) / sin(psi)] L(R) J de daz / R^2 ,   K = Pt G0^2 lambda^2 / (4 pi)^3 / loss
// which is the radar equation dP = K g^2 sigma0 dA L / R^4 with dA = R^2 dOmega / sin(psi), and J =
// cos(azimuth) on a cone scan. On a plane scan the solid angle is cos(e) de daz, but the beam is an
// angle on the sky: in the azimuth of the horizontal plane it is 1/cos(e) wider, and J = 1 counts
// the power of that. (The widening itself, 0.5 % at 6 deg, is neglected for surfaces.) Flat ground
// then gives the seed's patch R phi dR / cos(psi). Its power is spread evenly over the range
// interval that the ray stands for: half way to its neighbours on the same surface, along its own
// facet where that is steep and at a silhouette, never across one.
//
// How it samples: elevations follow the visible range cells (elevation_fan.h), in each sub-column at
// another place between their borders; each ray of the fan has its own azimuth inside its sub-column,
// by the golden-ratio sequence, because regular azimuths hit or miss oblique walls (one put between two
// has that of the lower one); neighbours that are more than a cell apart, hit different surfaces, or see
// different materials a quarter of a C-scope row apart, are refined by halving.
//
// Neglected: secondary bounces, refraction, diffraction. Accuracy over sampling:
// docs/performance.md; closed forms on flat ground within 0.05 dB (reference) and 0.5 dB (one ray
// per cell).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/frame_path_loss.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

class RayCaster : public Caster {
 public:
  // `world` must outlive the caster.
  RayCaster(const World& world, const Sampling& sampling);

  using Caster::cast;
  void cast(const sensors::AntennaFrame& frame, bool with_cscope, const CastPass& pass,
            FanSums& sums, SightLines& sight) const override;

  // Only these groups of kGroupAzimuths sub-columns, in a fan that is laid out: their sums are
  // written whatever they held, counts go up. For casters that leave some azimuths to rays.
  void cast_groups(const sensors::AntennaFrame& frame, bool with_cscope, int level,
                   const std::vector<std::uint32_t>& groups, FanSums& sums) const;

  // Every ray of a frame as level 0 sends it, in packets, for the bare-pass benchmark.
  std::vector<terrain::RayPacket<16>> packets(const sensors::AntennaFrame& frame) const;

 private:
  struct Pass;
  void cast_once(const sensors::AntennaFrame& frame, bool with_cscope, const Pass& pass,
                 const std::vector<std::uint32_t>& groups, FanSums& sums) const;

  const World& world_;
  Sampling sampling_;
  ElevationFan fan_;
  sensors::TwoWayTable elevation_gain_;
  FramePathLoss path_loss_;
};

}  // namespace fanbeam::renderer
