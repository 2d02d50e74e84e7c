// Azimuth side lobes: what a uniform level outside the main beam picks up from the whole fan.
//
//     P(column) += s^2 * integral of p(az) over cut < |az - az_column| <= extent
// with p the power per radian of FanSums, constant inside a sub-column, and s the one-way level.
// One running sum over azimuth serves all columns: exact for a uniform level, two differences per
// cell. Elevation side lobes need no stage: they are in the elevation table of the casters.
//
// Neglected: what lies outside the fan, which ends a beam's cut beyond the field of view. For even
// ground all round and an extent of 90 deg, HiVision's fan of 43.5 deg holds 22 to 24 % of the
// power; the level of the lobes is less well known than these 6 dB. Structure of the lobes; the
// narrowing of azimuth away from the horizon (cos of the elevation, 0.3 dB at 20 deg).
//
// Bound, dB: side lobes add power, so with L the two-way power that they collect over what the main
// beam collects from the same surroundings, a cell at the display's floor beside surroundings at
// the window's top changes by at most
//     10 log10(1 + L h 10^((high - low) / 10)) ,
// never more than the window. L = (s_az^2 W + lobes of the shape) / two-way width, W the two-sided
// angle from cut to extent or the fan, whichever is less, plus the largest two-way elevation lobe.
// h = 40 dB of headroom: surroundings and targets may be brighter than the window's top by that
// much (the brightest surface, metal facing the radar, is 27 dB over; 4e5 m^2 at 200 m).
#pragma once

#include <vector>

#include "renderer/casting/caster.h"
#include "renderer/plan/scene_facts.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// `sums` [sub-column][bin] -> added to `image` [bin][column]. Leaves the image alone when the
// azimuth has no side-lobe level.
void add_azimuth_side_lobes(const std::vector<double>& sums, int bins, const FanSums& fan,
                            const sensors::Sensor& sensor, std::vector<double>& image);

// A level is set, or a shape reaches beyond its first null.
bool has_side_lobes(const SceneFacts& facts);
double side_lobe_bound_dB(const SceneFacts& facts);

// The sensor as it is simulated when the effect is off: its antenna cut at the main beam.
sensors::Sensor without_side_lobes(const sensors::Sensor& sensor);

}  // namespace fanbeam::renderer
