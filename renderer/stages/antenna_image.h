// What the whole antenna makes of a fan, main beam and side lobes in azimuth: azimuth_beam.h and
// side_lobes.h, one after the other. Elevation is in the casters' tables.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/stages/azimuth_beam.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// `sums` [sub-column][bin], per radian, to an image [bin][column]. `filled`: as in azimuth_beam.h.
std::vector<double> through_antenna(const std::vector<double>& sums, int bins, const FanSums& fan,
                                    const sensors::Sensor& sensor, int sub_columns_per_column,
                                    const FilledBlocks* filled = nullptr);

}  // namespace fanbeam::renderer
