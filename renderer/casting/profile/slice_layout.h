// Which azimuth slices a frame is cut along.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

// All slices of a fan whose azimuths are upright, by rising heading, in the middles of the wedges
// that they stand for: those of sub-column s are numbers [s n, (s + 1) n), n = `per_sub_column`.
std::vector<Slice> level_slices(const World& world, int per_sub_column,
                                const sensors::AntennaFrame& antenna, const FanSums& sums);

// For any antenna: evenly over all headings in which some elevation of the beam sees the fan; all
// round, each once, where the nadir is in it.
std::vector<Slice> tilted_slices(const World& world, int per_sub_column,
                                 const sensors::AntennaFrame& antenna, const FanSums& sums);

// The slices that one sub-column gathers.
struct SubColumnSlices {
  std::size_t sub_column, begin, end;
};
// What of `level_slices` is cast: the sub-columns of `groups` that are not marked as left to rays.
std::vector<SubColumnSlices> slices_of_groups(const std::vector<std::uint32_t>& groups,
                                              const std::vector<std::uint8_t>& for_rays,
                                              int slices_per_sub_column);
// Those of `groups` that have a sub-column left to rays.
std::vector<std::uint32_t> groups_of_rays(const std::vector<std::uint32_t>& groups,
                                          const std::vector<std::uint8_t>& for_rays);

}  // namespace fanbeam::renderer
