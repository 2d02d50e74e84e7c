// A scanning radar's B-scope at signal level: echoes to beat signals, column by column, and beat
// signals to received power in range cells.
//
// Beat. A column's beam weighs every echo with its two-way pattern g towards it
// (sensors/antenna/column_place.h): paths of amplitude sqrt(g P) exp(j phase) under the column's
// sweep (column_sweep.h), by beat_synthesis.h.
//
// Cells. With x[n] a column's N samples, w the window of the sensor's sweep and r_k the middle of
// range cell k,
//     P_k = | sum over n of w[n] x[n] exp(-j 2 pi n r_k / (N cell)) exp(j 2 pi f_v t_n) |^2
//           / (N sum w^2) ,
// f_v = 2 v fc / c what takes the shift of an own closing speed v off the spectrum. White noise of
// k T0 F fs in a sample leaves k T0 F / T' in every cell, and the cells of one echo sum to its
// power: the scale of the picture that the renderer makes (noise_power_W of the sensor).
//
// What an own speed v shifts unless it is taken off: fc v / S in range, S = B/T (41.5 m for HiVision
// at 70 m/s, towards the radar). Taken off, v (1 - cos azimuth cos elevation) of it remains.
//
// Window: cosine sums exactly as sensors/receiver/point_response.h has them; E-UNSUPPORTED for
// Window::none, an ideal cell that no sweep has.
// Neglected: echoes from beyond the range gate; what column_sweep.h says.
// Accuracy: that of the synthesis, 1e-4 of the column's strongest; transforms 1e-14. Same bits for
// any number of threads. Cost of a HiVision column: 1 us a path.
#pragma once

#include <span>
#include <vector>

#include "core/echo.h"
#include "sensors/sensor.h"
#include "signal/cube.h"

namespace fanbeam::signal {

// One ramp of every column: shape samples x columns x 1. `phase_rad` is each echo's own. Throws
// InputError as column_sweep, InternalError when the two lists differ in length.
FloatCube scan_beat(const sensors::Sensor& sensor, std::span<const core::Echo> echoes,
                    std::span<const double> phase_rad);

// Received power, [range cell][column], row 0 the nearest cell. The cube must have the shape that
// scan_beat gives it; InternalError otherwise. `closing_speed_mps`: what is taken off; 0 for a
// sensor without compensation.
std::vector<double> scan_cells_W(const sensors::Sensor& sensor, const FloatCube& beat,
                                 double closing_speed_mps);

}  // namespace fanbeam::signal
