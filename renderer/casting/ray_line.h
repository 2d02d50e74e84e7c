// Rays, each told with what it met: for stages that want the rays themselves and not their sums over
// cells. Neighbours asked for one after the other make packets that stay together: four sub-columns
// row by row take 0.75 of the time (docs/performance-notes.md).
#pragma once

#include <algorithm>

#include "renderer/casting/echo_density.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/packet_sender.h"
#include "renderer/casting/ray_aim.h"
#include "renderer/casting/ray_batch.h"
#include "renderer/casting/ray_chain.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// Where a ray goes.
struct RayPlace {
  const SubColumn& column;
  double elevation_rad = 0.0;
  double across = 0.5;  // share of the sub-column's width, from its left
};

class RayLine {
 public:
  // All must outlive it.
  RayLine(const World& world, const sensors::AntennaFrame& antenna,
          const sensors::TwoWayTable& elevation_gain, const PathLossTable& path_loss)
      : elevation_gain_(elevation_gain),
        boresight_rad_(world.sensor.antenna.boresight_elevation_rad),
        aim_(antenna, world.sensor.scan.surface == sensors::ScanSurface::cone,
             azimuths_are_upright(antenna, world.sensor.scan.surface)),
        sender_(world.surfaces(), world.sensor.range, antenna.position_m, nullptr),
        density_(world, path_loss, antenna.position_m) {}

  // Calls `place(ray)` for each of `count` rays, which says where it goes, and then
  // `keep(ray, batch, chain, lane)` with what it met, in order.
  template <class Place, class Keep>
  void cast(int count, const Place& place, const Keep& keep) {
    for (int first = 0; first < count; first += kBatchRays) {
      const int filled = std::min(kBatchRays, count - first);
      for (int lane = 0; lane < filled; ++lane) {
        const RayPlace at = place(first + lane);
        batch_.set_column(lane, at.column);
        batch_.elevation_rad[lane] = at.elevation_rad;
        batch_.gain[lane] = elevation_gain_(at.elevation_rad - boresight_rad_);
        batch_.offset_rad[lane] = at.column.offset_rad(at.across);
      }
      batch_.close(filled);
      aim_.point(batch_);
      sender_.cast(batch_);
      chain_.clear();
      chain_.append(kBatchRays);
      density_.shade(batch_, 0, chain_);
      for (int lane = 0; lane < filled; ++lane) keep(first + lane, batch_, chain_, lane);
    }
  }

 private:
  const sensors::TwoWayTable& elevation_gain_;
  double boresight_rad_;
  RayAim aim_;
  // Rays this far apart gain nothing from wider packets.
  PacketSender<8> sender_;
  EchoDensity density_;
  RayBatch batch_;
  RayChain chain_;
};

}  // namespace fanbeam::renderer
