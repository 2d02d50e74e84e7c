// Azimuth side lobes: what a uniform level outside the main beam picks up from the whole fan.
//
//     P(column) += s^2 * integral of p(az) over cut < |az - az_column| <= extent
// with p the power per radian of FanSums, constant inside a sub-column, and s the one-way level.
// One running sum over azimuth serves all columns: exact for a uniform level, two differences per
// cell. Elevation side lobes need no stage: they are in the elevation table of the casters.
//
// Neglected: what lies outside the fan, which ends a beam's cut beyond the field of view. For even
// ground all round and an extent of 90 deg, HiVision's fan of 43.5 deg holds 22 to 24 % of the
// power; the level of the lobes is less well known than these 6 dB. Over the seam of a full-circle scan the
// side lobes of surfaces end with the fan's margin as well. Structure of the lobes; the
// narrowing of azimuth away from the horizon (cos of the elevation, 0.3 dB at 20 deg).
//
// Bound, dB: side lobes add power, so a pixel changes by at most 10 log10(1 + p / floor)
// (display_floor.h) with p the largest echo of what the scene holds (largest_echo.h) through the
// part of the pattern that the effect adds,
//     Omega = A E - A_main E_main ,
// A and E the two-way integrals over azimuth and elevation with all lobes, A_main and E_main those
// of the main beams; point targets with the largest two-way gain outside a main beam. A display of
// mapping stc, or seed where the sensor has no [seed], counts in azimuth widths, and lobes inside the cut
// make the beam A_cut / A_main times as wide: what they add nothing to gets darker by 10 log10 of that;
// the larger change counts. Where double bounce is possible no echo has a bound: the whole window, however
// faint the lobes. Per solid angle of its first ray a pair returns up to 4 K rho S / R3^2 (bounce_tracer.h),
// rho <= 1, S = sigma_B / sin(psi_i) the largest of any material, some 200 of metal that is grazed; but R3,
// from the lit surface to the antenna, is not bounded by the range of the cell: it is as short as the nearest
// wall is near. Written the other way round, over the solid angle under which that surface is
// seen, 4 K rho S / (R1 + R2)^2 holds with R1 + R2 at least the cell's range, but once for every mirror
// that lights it, and nothing counts those. Told from how near a flight comes to any surface, lobes of
// -75 dB in azimuth would count 0.1 dB from 200 m off and 18 dB from 3 m (S = 100): of no use for landings.
// Lobes in elevation would count by their level once, not squared: one way of a pair may be in the
// main beam. The whole window, too, where lobes in elevation change how the two paths to a target over
// mirroring ground cancel.
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
