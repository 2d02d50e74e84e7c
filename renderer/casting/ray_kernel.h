// The work on one group of sub-columns: place, cast, refine, deposit. Private to the ray caster.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/elevation_fan.h"
#include "renderer/casting/nrcs_table.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// Sub-columns that are cast together: with as many elevations they make packets square in angle.
inline constexpr int kGroupAzimuths = 4;

// What all groups of a frame share.
struct RayFrame {
  const World& world;
  const Sampling& sampling;
  const ElevationFan& fan;
  const std::vector<NrcsTable>& nrcs;
  const sensors::AntennaFrame& antenna;
  const sensors::TwoWayTable& elevation_gain;
  const PathLossTable& path_loss;
  double radar_constant_W_m2 = 0.0;
  bool with_cscope = false;
};

// One ray after its cast: where it went and the power per solid angle that came back.
struct CastRay {
  double elevation_rad = 0.0;
  float range_m = 0.0F;
  float range_slope = 0.0F;  // q: the facet's plane lies at R / (1 + q de) for a ray de higher
  float density_W_per_rad2 = 0.0F;          // dP / (de daz)
  std::uint32_t surface = terrain::kNoHit;  // rays with equal surface may share a range interval
};

// Buffers of one thread, kept from group to group so that the ray loop does not allocate.
struct RayScratch {
  std::vector<double> edges;
  std::array<std::vector<CastRay>, kGroupAzimuths> rays;
  std::vector<CastRay> merged;
  struct Request {
    double elevation_rad;
    int azimuth;
  };
  std::array<std::vector<double>, kGroupAzimuths> wanted;
  std::vector<Request> requests;
  std::array<std::vector<CastRay>, kGroupAzimuths> refined;
  std::uint64_t ray_count = 0, hit_count = 0, blanked_count = 0;
};

// Casts sub-columns [4 group, 4 group + 4) and adds their power to `sums`. The packet size of
// `record` is the one used; when not null it receives a copy of every packet as it was sent.
void cast_group(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
                std::vector<terrain::RayPacket<8>>* record);
void cast_group(const RayFrame& frame, int group, RayScratch& scratch, FanSums& sums,
                std::vector<terrain::RayPacket<16>>* record);

}  // namespace fanbeam::renderer
