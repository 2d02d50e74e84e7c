// The expected B-scope of a radar whose range cells are the bins of a sweep's spectrum, as exactly
// as a picture of powers can say it: what beat signals are held against.
//
// A bin sees a scatterer through the sweep's point response h (sensors/receiver/point_response.h),
// by its distance from the bin's middle:
//     P(k) = sum over thin cells j of p(j) h(r_j - r_k) cell ,
// p the power in cells cut into `parts`, without a range response of their own. The effect
// range-response (renderer/stages/range_response.h) starts from whole cells instead and averages
// over the receiving cell too: an echo then keeps 0.62 of its power in its cell where the bins of a
// -35 dB Taylor window keep 0.70 on average over its places, and edges are as much softer.
//
// Neglected: where in its thin cell a scatterer stands. With 8 parts and a -35 dB Taylor window, power
// spread evenly over a thin cell is met to 0.05 dB up to a bin away, a lone scatterer at its edge to
// 0.6 dB half a bin away. Cost: cells^2 x parts x columns.
#pragma once

#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::renderer {

// The sensor with range cells cut into `parts` and no range response: for the frame whose powers
// swept_power_W takes. Its noise and display are not those of `sensor`. E-RANGE unless 1 to 64.
sensors::Sensor thin_cells(sensors::Sensor sensor, int parts);

// `thin_W` [thin cell][column], of thin_cells(sensor, parts); the result [cell][column], without
// noise. The sensor must have a point response; InternalError for a picture of another size.
std::vector<double> swept_power_W(const sensors::Sensor& sensor, const std::vector<double>& thin_W,
                                  int parts);

}  // namespace fanbeam::renderer
