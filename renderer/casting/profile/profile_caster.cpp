#include "renderer/casting/profile/profile_caster.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/parallel.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/casting/heading.h"
#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/sight_points.h"
#include "renderer/casting/profile/slice_exclusion.h"
#include "renderer/casting/profile/slice_gather.h"
#include "renderer/casting/profile/slice_layout.h"

namespace fanbeam::renderer {
namespace {

// A tilted antenna looks anywhere.
constexpr double kSteepest = 1e9;

// Tangent of the elevation below which nothing comes back.
double dark_below(const sensors::Antenna& beams, bool level) {
  if (!level) return -kSteepest;
  const double lowest_rad =
      std::max(beams.boresight_elevation_rad - sensors::reach_rad(beams.elevation) - kLeaning_rad,
               -std::atan(kSteepest));
  return std::tan(lowest_rad);
}

// A level of rays has as many as all before it, one of slices twice as many as the one before.
int ray_level(int level) { return level == 0 ? 0 : level + 1; }

// Those of `groups` that are marked, and all that was counted on the way.
void take_sub_columns(const FanSums& from, const std::vector<std::uint8_t>& marked,
                      const std::vector<std::uint32_t>& groups, FanSums& to) {
  const auto copy = [&](const std::vector<double>& bins, int count, std::vector<double>& into) {
    for (const std::uint32_t group : groups)
      for (std::size_t sub = group * std::size_t{kGroupAzimuths};
           sub < (group + 1) * std::size_t{kGroupAzimuths}; ++sub)
        if (marked[sub] != 0)
          std::copy_n(bins.data() + sub * static_cast<std::size_t>(count), count,
                      into.data() + sub * static_cast<std::size_t>(count));
  };
  copy(from.range_W_per_rad, to.cells, to.range_W_per_rad);
  copy(from.elevation_W_m3_per_rad, to.rows, to.elevation_W_m3_per_rad);
  add_counts(from, to);
}

}  // namespace

ProfileCaster::ProfileCaster(const World& world, const Sampling& sampling)
    : world_(world),
      sampling_(sampling),
      rings_(plan_rings(world)),
      tables_(world),
      path_loss_(world) {
  if (!world.solids().others.empty()) rays_ = std::make_unique<RayCaster>(world, sampling);
  if (world.surfaces().terrain() == nullptr)
    throw core::InternalError("slices without a ground to cut");
}

void ProfileCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope,
                         const CastPass& pass, FanSums& sums, SightLines& sight) const {
  const bool level = azimuths_are_upright(antenna, world_.sensor.scan.surface);
  if (!level && rays_) {
    rays_->cast(antenna, with_cscope, {ray_level(pass.level), pass.groups}, sums, sight);
    return;
  }
  lay_out_fan(world_, sampling_, with_cscope, sums);
  if (level)
    cast_level(antenna, with_cscope, pass, sums, sight);
  else
    cast_across(antenna, slices_per_sub_column(pass.level), sums, sight);
  // Beyond the slices, and in azimuths left to rays.
  look_along_rays(world_.surfaces(), antenna.position_m, sight);
}

// Calls `gather` with what all slices of a frame share.
template <class Gather>
void ProfileCaster::sweep(const sensors::AntennaFrame& antenna, const std::vector<Slice>& slices,
                          int per_sub_column, SightLines& sight, const Gather& gather) const {
  // About a column's worth: fewer candidates, or fewer lists that an edge is in.
  const auto tile = static_cast<std::size_t>(std::min(sampling_.sub_columns * per_sub_column, 16));
  const glm::dvec2 forward = horizontal(antenna.forward);
  const EdgeIndex edges(rings_, world_.sensor.range.maximum_m(), antenna.position_m, forward,
                        slices, tile);
  sight.clear.assign(sight.to_m.size(), kAskRays);
  const PointsOfSlices points = sort_points(slices, antenna.position_m, forward, sight);
  const PathLossTable path_loss = path_loss_.from(antenna.position_m.z);
  const bool level = azimuths_are_upright(antenna, world_.sensor.scan.surface);
  gather(SliceFrame{world_, antenna, tables_, path_loss, slices, edges, points, sight.clear.data(),
                    tile, dark_below(world_.sensor.antenna, level)});
}

void ProfileCaster::cast_level(const sensors::AntennaFrame& antenna, bool with_cscope,
                               const CastPass& pass, FanSums& sums, SightLines& sight) const {
  const int per_sub = slices_per_sub_column(pass.level);
  const std::vector<Slice> slices = level_slices(world_, per_sub, antenna, sums);
  const std::vector<std::uint32_t> asked = pass.groups != nullptr ? *pass.groups : groups_of(sums);
  const auto for_rays = sub_columns_for_rays(world_, antenna, slices, per_sub, sums);
  const auto groups = groups_of_rays(asked, for_rays);
  const auto columns = slices_of_groups(asked, for_rays, per_sub);
  FanSums rays;  // of whole groups: more than what is left to them
  // One after the other: a thread that waits for one of two loops takes no part in the other.
  if (!groups.empty()) {
    lay_out_fan(world_, sampling_, with_cscope, rays);
    rays_->cast_groups(antenna, with_cscope, ray_level(pass.level), groups, rays);
  }
  sweep(antenna, slices, per_sub, sight,
        [&](const SliceFrame& frame) { gather_level(frame, columns, sums); });
  sums.slices = columns.size() * static_cast<std::size_t>(per_sub);
  if (!groups.empty()) take_sub_columns(rays, for_rays, groups, sums);
}

void ProfileCaster::cast_across(const sensors::AntennaFrame& antenna, int per_sub_column,
                                FanSums& sums, SightLines& sight) const {
  const std::vector<Slice> slices = tilted_slices(world_, per_sub_column, antenna, sums);
  sweep(antenna, slices, per_sub_column, sight,
        [&](const SliceFrame& frame) { gather_across(frame, sums); });
  sums.slices = slices.size();
}

}  // namespace fanbeam::renderer
