// Which azimuths slices cannot show: where something stands that a vertical cut does not describe.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

// An antenna that counts as level leans by half of this at most.
inline constexpr double kLeaning_rad = 2e-3;

// Marks, with 1, the sub-columns in whose wedges some box of Solids::others may stand. A level
// antenna may lean by 1 mrad, which moves a point by the tangent of its elevation times as much in
// azimuth: 2 mrad beside the wedges cover elevations to 60 deg.
std::vector<std::uint8_t> sub_columns_for_rays(const World& world,
                                               const sensors::AntennaFrame& antenna,
                                               const std::vector<Slice>& slices,
                                               int slices_per_sub_column, const FanSums& sums);

}  // namespace fanbeam::renderer
