// B-scope and C-scope pictures from power arrays.
//
// Arrays are row-major [row][column], columns left to right in azimuth.
//   B-scope  row 0 is the nearest range cell; range.cells x scan.columns
//   C-scope  row 0 is the highest elevation; display.cscope_rows x scan.columns
// Eight-bit pictures have the farthest range, or the highest elevation, on top. Grey: see
// grey_scale.h.
// Input arrays of another size are a broken invariant (core::InternalError).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

using core::Picture8;

// Unrounded grey, 0 to 255, of received power in W (with its noise). Errors as GreyScale.
std::vector<double> bscope_grey(const Sensor& sensor, std::span<const double> power_W);
// Unrounded grey of the sum over range of P R^3, in W m^3 (with its noise). Errors as GreyScale.
std::vector<double> cscope_grey(const Sensor& sensor, std::span<const double> compensated_W_m3);

// Rounds as grey8; the B-scope is turned so that the farthest range is on top.
Picture8 bscope_picture(const Sensor& sensor, std::span<const double> grey);
Picture8 cscope_picture(const Sensor& sensor, std::span<const double> grey);

// What a fan-beam radar can show as a C-scope: it has no elevation, so every echo of a range R is
// taken to be flat ground `height_m` below the antenna, at elevation -asin(h / R).
//
// A range cell stands for the interval of elevations between its two edges (-90 deg where R < h);
// its P R^3 is spread over the rows of the C-scope in proportion to what they cover of it. What
// lies outside the window is lost.
// Input: B-scope power in W, with its noise. Result: W m^3, as cscope_grey takes it.
// Elevation counts from the local horizontal, which is the antenna's own when the scan is
// stabilised.
// Neglected: terrain, curvature (1.1 m at 3.7 km), refraction.
// Throws InputError E-RANGE unless height_m is above 0, E-NONFINITE when it is not finite.
std::vector<double> flat_earth_cscope_W_m3(const Sensor& sensor, std::span<const double> power_W,
                                           double height_m);

// Mean noise of a C-scope pixel of mode true_elevation, in W m^3: the noise N of every range cell
// counts N R^3, and a receiver that resolved elevation would share it evenly among its rows. The
// B-scope's is sensor.noise_power_W().
double cscope_noise_W_m3(const Sensor& sensor);

}  // namespace fanbeam::sensors
