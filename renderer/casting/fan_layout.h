// The fan of sub-columns that a frame is cast in: how it lies, in which groups, and when its
// azimuths are vertical planes.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

// Sub-columns that are cast together: with as many elevations they make packets square in angle.
inline constexpr int kGroupAzimuths = 4;

// Number of sub-columns left and right of the picture that the azimuth beam reaches into.
int margin_sub_columns(const sensors::Sensor& sensor, int sub_columns_per_column);

// Lays out the fan of a frame: every sub-column that the beam of some column reaches, in whole
// groups. Sums are not zeroed, counts are.
void lay_out_fan(const World& world, const Sampling& sampling, bool with_cscope, FanSums& sums);

// Numbers of the groups that a frame casts, rising: all of the fan.
std::vector<std::uint32_t> groups_of(const FanSums& sums);

// Groups of `sums` become `own` times what they hold plus `share` times those of `other`.
void combine_groups(const FanSums& other, double share, const std::vector<std::uint32_t>& groups,
                    double own, FanSums& sums);
// Numbers of rays, slices, hits.
void add_counts(const FanSums& from, FanSums& to);

// An antenna tilted less than this (0.06 deg) sees a column as one vertical plane.
inline constexpr double kLevelCosine = 1.0 - 5e-7;

// Whether every azimuth of the scan is one vertical half-plane.
inline bool azimuths_are_upright(const sensors::AntennaFrame& antenna,
                                 sensors::ScanSurface surface) {
  return surface == sensors::ScanSurface::plane && antenna.up.z > kLevelCosine;
}

}  // namespace fanbeam::renderer
