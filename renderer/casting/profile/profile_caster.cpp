#include "renderer/casting/profile/profile_caster.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/errors.h"
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

std::vector<double> headings_rad_of(const std::vector<Slice>& slices) {
  std::vector<double> headings_rad;
  headings_rad.reserve(slices.size());
  for (const Slice& slice : slices) headings_rad.push_back(slice.heading_rad);
  return headings_rad;
}

// Both rising.
std::vector<std::uint32_t> without(const std::vector<std::uint32_t>& all,
                                   const std::vector<std::uint32_t>& some) {
  std::vector<std::uint32_t> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}
std::vector<std::uint32_t> in_both(const std::vector<std::uint32_t>& some,
                                   const std::vector<std::uint32_t>& others) {
  std::vector<std::uint32_t> both;
  std::set_intersection(some.begin(), some.end(), others.begin(), others.end(),
                        std::back_inserter(both));
  return both;
}

}  // namespace

ProfileCaster::ProfileCaster(const World& world, const Sampling& sampling)
    : world_(world), sampling_(sampling), tables_(world), path_loss_(world) {
  if (!world.solids.others.empty()) rays_ = std::make_unique<RayCaster>(world, sampling);
  if (world.surfaces->terrain() == nullptr)
    throw core::InternalError("slices without a ground to cut");
}

void ProfileCaster::cast(const sensors::AntennaFrame& antenna, bool with_cscope,
                         const CastPass& pass, FanSums& sums, SightLines& sight) const {
  const bool level = azimuths_are_upright(antenna, world_.sensor.scan.surface);
  if (!level && rays_) {
    rays_->cast(antenna, with_cscope, pass, sums, sight);
    return;
  }
  lay_out_fan(world_, sampling_, with_cscope, sums);
  const SlicePlaces places = slice_places(sampling_, pass.level);
  const int per_sub = places.per_sub_column;
  const std::vector<Slice> slices = level ? level_slices(world_, places, antenna, sums)
                                          : tilted_slices(world_, places, antenna, sums);
  // About a column's worth: fewer candidates, or fewer lists that an edge is in.
  const auto tile = static_cast<std::size_t>(std::clamp(sampling_.sub_columns * per_sub, 4, 16));
  const glm::dvec2 forward = horizontal(antenna.forward);
  const EdgeIndex edges(world_, {antenna.position_m.x, antenna.position_m.y}, forward,
                        headings_rad_of(slices), tile);
  sight.clear.assign(sight.to_m.size(), kAskRays);
  const PointsOfSlices points = sort_points(slices, antenna.position_m, forward, sight);
  const PathLossTable path_loss = path_loss_.from(antenna.position_m.z);
  const SliceFrame frame{world_,       antenna,
                         tables_,      path_loss,
                         slices,       edges,
                         points,       sight.clear.data(),
                         tile,         dark_below(world_.sensor.antenna, level),
                         !pass.refined};
  if (level) {
    const std::vector<std::uint32_t> asked =
        pass.groups != nullptr ? *pass.groups : groups_of(sums);
    const auto for_rays = in_both(asked, groups_for_rays(world_, antenna, slices, per_sub, sums));
    const auto columns = slices_of_groups(without(asked, for_rays), per_sub);
    gather_level(frame, columns, sums);
    sums.slices = columns.size() * static_cast<std::size_t>(per_sub);
    if (!for_rays.empty()) rays_->cast_groups(antenna, with_cscope, pass.level, for_rays, sums);
  } else {
    gather_across(frame, sums);
    sums.slices = slices.size();
  }
  // Beyond the slices, and in azimuths left to rays.
  look_along_rays(*world_.surfaces, antenna.position_m, sight);
}

}  // namespace fanbeam::renderer
