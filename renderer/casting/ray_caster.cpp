#include "renderer/casting/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_kernel.h"

namespace fanbeam::renderer {
namespace {

std::vector<std::uint32_t> all_groups(const FanSums& sums) {
  std::vector<std::uint32_t> groups(static_cast<std::size_t>(sums.sub_columns / kGroupAzimuths));
  std::iota(groups.begin(), groups.end(), 0U);
  return groups;
}

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

}  // namespace

void lay_out_fan(const World& world, const Sampling& sampling, bool with_cscope, FanSums& sums) {
  const sensors::Scan& scan = world.sensor.scan;
  const int margin = margin_sub_columns(world.sensor, sampling.sub_columns);
  sums.step_rad = scan.column_width_rad() / sampling.sub_columns;
  sums.first_azimuth_rad = -scan.field_of_view_rad / 2 - margin * sums.step_rad;
  const int needed = scan.columns * sampling.sub_columns + 2 * margin;
  sums.sub_columns = (needed + kGroupAzimuths - 1) / kGroupAzimuths * kGroupAzimuths;
  sums.cells = world.sensor.range.cells;
  sums.rows = with_cscope ? world.sensor.display.cscope_rows : 0;
  const auto subs = static_cast<std::size_t>(sums.sub_columns);
  sums.range_W_per_rad.resize(subs * static_cast<std::size_t>(sums.cells));
  sums.elevation_W_m3_per_rad.resize(subs * static_cast<std::size_t>(sums.rows));
  sums.rays = sums.slices = sums.hits = sums.blanked = 0;
}

int margin_sub_columns(const sensors::Sensor& sensor, int sub_columns_per_column) {
  const double step_rad = sensor.scan.column_width_rad() / sub_columns_per_column;
  return static_cast<int>(std::ceil(sensor.antenna.azimuth.cut_rad / step_rad));
}

RayCaster::RayCaster(const World& world, const Sampling& sampling)
    : world_(world),
      sampling_(sampling),
      fan_(world, sampling_),
      elevation_gain_(world.sensor.antenna.elevation) {
  for (const materials::NrcsCurve& nrcs : world.nrcs) nrcs_.emplace_back(nrcs);
  if (const terrain::HeightField* ground = world.surfaces->terrain(); ground != nullptr) {
    const auto [low, high] = std::minmax_element(ground->height_m.begin(), ground->height_m.end());
    lowest_m_ = *low;
    highest_m_ = *high;
  }
}

PathLossTable RayCaster::path_loss_from(double sensor_height_m) const {
  // Buildings and models rise above the ground; higher tops would be clamped to this.
  return {world_.attenuation, sensor_height_m, std::min(sensor_height_m, lowest_m_) - 10.0,
          std::max(sensor_height_m, highest_m_) + 300.0};
}

void RayCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope, FanSums& sums,
                     SightLines& sight) const {
  sight.clear.assign(sight.to_m.size(), kAskRays);
  look_along_rays(*world_.surfaces, antenna.position_m, sight);
  lay_out_fan(world_, sampling_, with_cscope, sums);
  cast_groups(antenna, with_cscope, all_groups(sums), sums);
}

void RayCaster::cast_groups(const sensors::AntennaFrame& antenna, bool with_cscope,
                            const std::vector<std::uint32_t>& groups, FanSums& sums) const {
  const PathLossTable path_loss = path_loss_from(antenna.position_m.z);
  const RayFrame frame{world_,  sampling_,       fan_,      nrcs_,
                       antenna, elevation_gain_, path_loss, with_cscope};
  if (world_.surfaces->native_packet() == 16) {
    cast_all<16>(frame, groups, sums, nullptr);
  } else {
    cast_all<8>(frame, groups, sums, nullptr);
  }
}

std::vector<terrain::RayPacket<16>> RayCaster::packets(const sensors::AntennaFrame& antenna) const {
  FanSums sums;
  lay_out_fan(world_, sampling_, true, sums);
  const PathLossTable path_loss = path_loss_from(antenna.position_m.z);
  const RayFrame frame{world_, sampling_, fan_, nrcs_, antenna, elevation_gain_, path_loss, true};
  std::vector<std::vector<terrain::RayPacket<16>>> groups;
  cast_all<16>(frame, all_groups(sums), sums, &groups);
  std::vector<terrain::RayPacket<16>> packets;
  for (const auto& group : groups) packets.insert(packets.end(), group.begin(), group.end());
  return packets;
}

}  // namespace fanbeam::renderer
