// Point scatterers: reflectors, posts, lights and whatever is smaller than a ray.
//
//     P(column) = K sigma g_el(el)^2 g_az((az - az_column) cos el)^2 L / R^4   (a cone scan: without cos el)
// in the one range cell that holds R (rectangular range response). Visibility is the caster's
// (SightLines): one ray to the scatterer, or the horizon of the azimuth slice it stands in. With
// `multipath` the ground's mirror joins (ground_multipath.h): a target then may have one echo for
// each range cell that its paths end in. Neglected: shadow of the scatterer itself.
#pragma once

#include <cstdint>
#include <vector>

#include "core/echo.h"
#include "renderer/casting/caster.h"
#include "renderer/stages/ground_multipath.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

struct TargetEchoes {
  // With power at azimuth gain 1; `object_id` is the target's index; the radial speed is left at 0.
  // Sorted as the targets are.
  std::vector<core::Echo> echoes;
  // Targets without a direction in the antenna's frame: at it, and abeam of it or behind it unless
  // beams of a plane scan reach there (sensors::beams_reach_behind).
  std::uint64_t unprojected = 0;
};

// Of all targets at `time_s` that a beam of the scan reaches inside the range gate, as if nothing
// stood between.
TargetEchoes unobstructed_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                 double time_s);

// Whether that has an echo of `target`.
bool in_view(const sensors::Sensor& sensor, const PointTarget& target,
             const sensors::AntennaFrame& antenna, double time_s);

// Lines of sight to the targets of `echoes`, to be answered by a caster.
SightLines sight_lines(const World& world, const std::vector<core::Echo>& echoes, double time_s);

// What remains of `echoes` where the sight is clear, with what the ground adds.
std::vector<core::Echo> seen_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                    const std::vector<core::Echo>& echoes, const SightLines& sight,
                                    Multipath multipath);

// All three with one ray for each line of sight.
std::vector<core::Echo> point_echoes(const World& world, const sensors::AntennaFrame& antenna,
                                     double time_s, Multipath multipath = Multipath::none);

// Adds the echoes to a B-scope [cell][column] in watts and, when not empty, a C-scope [row][column]
// in W m^3.
void add_echoes(const std::vector<core::Echo>& echoes, const sensors::Sensor& sensor,
                std::vector<double>& bscope_W, std::vector<double>& cscope_W_m3);

}  // namespace fanbeam::renderer
