#include "renderer/casting/ray_caster.h"

#include <mutex>

#include "core/parallel.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/radical_inverse.h"
#include "renderer/casting/ray_kernel.h"

namespace fanbeam::renderer {
namespace {

// `record` keeps the packets of each group in group order.
template <int N>
void cast_all(const RayFrame& frame, const std::vector<std::uint32_t>& groups, FanSums& sums,
              std::vector<std::vector<terrain::RayPacket<N>>>* record) {
  std::mutex totals;
  if (record != nullptr) record->resize(groups.size());
  core::parallel_for(groups.size(), [&](std::size_t i) {
    thread_local RayScratch scratch;
    scratch.ray_count = scratch.hit_count = scratch.blanked_count = 0;
    std::vector<terrain::RayPacket<N>>* packets = record != nullptr ? &(*record)[i] : nullptr;
    cast_group(frame, static_cast<int>(groups[i]), scratch, sums, packets);
    const std::lock_guard<std::mutex> lock(totals);  // whole numbers: their sum has no order
    sums.rays += scratch.ray_count;
    sums.hits += scratch.hit_count;
    sums.blanked += scratch.blanked_count;
  });
}

// Pass 0 is that of level 0.
RayPlaces whole_places(int pass) {
  const PassPlace place = pass_place(pass);
  return {0.0, 1.0, place.azimuth_shift, place.elevation};
}
RayPlaces strip_places(int passes, int pass) {
  RayPlaces places = whole_places(passes + pass);
  places.strip_begin = static_cast<double>(pass) / passes;
  places.strip_width = 1.0 / passes;
  return places;
}

}  // namespace

struct RayCaster::Pass {
  const Sampling& sampling;
  const ElevationFan& fan;
  RayPlaces places;
};

RayCaster::RayCaster(const World& world, const Sampling& sampling)
    : world_(world),
      sampling_(sampling),
      fan_(world, sampling_),
      elevation_gain_(world.sensor.antenna.elevation),
      path_loss_(world) {}

void RayCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope, const CastPass& pass,
                     FanSums& sums, SightLines& sight) const {
  sight.clear.assign(sight.to_m.size(), kAskRays);
  look_along_rays(world_.surfaces(), antenna.position_m, sight);
  lay_out_fan(world_, sampling_, with_cscope, sums);
  cast_groups(antenna, with_cscope, pass.level,
              pass.groups != nullptr ? *pass.groups : groups_of(sums), sums);
}

void RayCaster::cast_groups(const sensors::AntennaFrame& antenna, bool with_cscope, int level,
                            const std::vector<std::uint32_t>& groups, FanSums& sums) const {
  if (level < 2) {
    cast_once(antenna, with_cscope, {sampling_, fan_, whole_places(level)}, groups, sums);
    return;
  }
  // As many rays as all levels before, half of the factor in elevation, half as strips of every
  // sub-column, each a pass of its own.
  const int finer = 1 << ((level - 1) / 2);
  const int strips = (1 << (level - 1)) / finer;
  const Sampling sampling = finer_in_elevation(sampling_, finer);
  const ElevationFan fan(world_, sampling);
  cast_once(antenna, with_cscope, {sampling, fan, strip_places(strips, 0)}, groups, sums);
  thread_local FanSums one;
  for (int strip = 1; strip < strips; ++strip) {
    lay_out_fan(world_, sampling_, with_cscope, one);
    cast_once(antenna, with_cscope, {sampling, fan, strip_places(strips, strip)}, groups, one);
    const double share = 1.0 / (strip + 1.0);  // a running mean
    combine_groups(one, share, groups, 1.0 - share, sums);
    add_counts(one, sums);
  }
}

void RayCaster::cast_once(const sensors::AntennaFrame& antenna, bool with_cscope, const Pass& pass,
                          const std::vector<std::uint32_t>& groups, FanSums& sums) const {
  const PathLossTable path_loss = path_loss_.from(antenna.position_m.z);
  const RayFrame frame{world_,          pass.sampling, pass.fan,    antenna,
                       elevation_gain_, path_loss,     with_cscope, pass.places};
  if (world_.surfaces().native_packet() == 16) {
    cast_all<16>(frame, groups, sums, nullptr);
  } else {
    cast_all<8>(frame, groups, sums, nullptr);
  }
}

std::vector<terrain::RayPacket<16>> RayCaster::packets(const sensors::AntennaFrame& antenna) const {
  FanSums sums;
  lay_out_fan(world_, sampling_, true, sums);
  const PathLossTable path_loss = path_loss_.from(antenna.position_m.z);
  const RayFrame frame{world_,          sampling_, fan_, antenna,
                       elevation_gain_, path_loss, true, whole_places(0)};
  std::vector<std::vector<terrain::RayPacket<16>>> groups;
  cast_all<16>(frame, groups_of(sums), sums, &groups);
  std::vector<terrain::RayPacket<16>> packets;
  for (const auto& group : groups) packets.insert(packets.end(), group.begin(), group.end());
  return packets;
}

}  // namespace fanbeam::renderer
