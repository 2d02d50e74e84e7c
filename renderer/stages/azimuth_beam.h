// The azimuth beam: what the antenna makes of power arriving from all azimuths when it points at
// each column's centre.
//
//     P(column) = integral p(az) g_az(az - az_column)^2 daz
// with p the power per radian of FanSums, constant inside a sub-column, and the squared pattern
// integrated exactly over it. Accuracy: that of the sub-columns.
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// `sums` [sub-column][bin] -> [bin][column], row-major. `margin` sub-columns lie left of the first
// column's edge.
std::vector<double> apply_azimuth_beam(const std::vector<double>& sums, int bins,
                                       const FanSums& fan, const sensors::Sensor& sensor,
                                       int sub_columns_per_column);

}  // namespace fanbeam::renderer
