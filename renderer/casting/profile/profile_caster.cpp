#include "renderer/casting/profile/profile_caster.h"

#include <algorithm>

#include "renderer/casting/fan_layout.h"
#include "renderer/casting/profile/slice_exclusion.h"
#include "renderer/casting/profile/slice_gather.h"
#include "renderer/casting/profile/slice_layout.h"

namespace fanbeam::renderer {
namespace {

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
    : world_(world), sampling_(sampling), scene_(world) {
  if (!world.solids().others.empty()) rays_ = std::make_unique<RayCaster>(world, sampling);
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
  scene_.in_frame(antenna, slices, sampling_.sub_columns * per_sub, sight,
                  [&](const SliceFrame& frame) { gather_level(frame, columns, sums); });
  sums.slices = columns.size() * static_cast<std::size_t>(per_sub);
  if (!groups.empty()) take_sub_columns(rays, for_rays, groups, sums);
}

void ProfileCaster::cast_across(const sensors::AntennaFrame& antenna, int per_sub_column,
                                FanSums& sums, SightLines& sight) const {
  const std::vector<Slice> slices = tilted_slices(world_, per_sub_column, antenna, sums);
  scene_.in_frame(antenna, slices, sampling_.sub_columns * per_sub_column, sight,
                  [&](const SliceFrame& frame) { gather_across(frame, sums); });
  sums.slices = slices.size();
}

}  // namespace fanbeam::renderer
