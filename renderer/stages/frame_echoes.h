// A frame as scatterers instead of powers in cells: what a signal simulation starts from.
//
// One echo for every ray that meets a surface, and those of the point targets. Each sub-column of
// azimuth is cut into the elevations of ElevationFan; every cut holds `passes` rays at random
// places inside it, which stand for equal parts of its solid angle. Power is that of ray_caster.h,
//     P = K g_el^2 [sigma0(psi) / sin(psi)] L(R) J de daz / (R^2 passes) ,
// at azimuth gain 1 (core/echo.h): whoever forms beams or has element patterns weighs it. The sum
// over a cell is an unbiased estimate of the power picture's expectation in that cell.
//
// phase_rad is the scatterer's own, uniform, a pure function of (seed, frame, look, place in the fan or
// number of the target): that of the path's length comes on top. With several echoes in a
// resolution cell their sum is fully developed speckle. A new frame draws new phases.
//
// Radial speed, positive receding: u . (v_target - v_own), u the line of sight. Surfaces stand
// still; a point target has the speed of the leg it is on.
//
// Neglected: echoes from rain and snow as a volume, double bounces, the azimuth side lobes beyond
// the fan, acceleration within a frame, rotation of the antenna (its lever arm), coherence from
// frame to frame, refraction. Rays that see the back of a facet bring nothing.
// Accuracy: with n rays in a cell the cell's power scatters by about 1/sqrt(n) of what varies
// inside it; ranges are those of the ray caster (ray_scene.h: floats, 25 mm at most within 10 km): a phase must
// not be worked out from them between rays, which is why it is drawn.
// Cost: about 1 us a ray on one thread. Same result for any number of threads.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/echo.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame_pose.h"
#include "renderer/stages/ground_multipath.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

// Of one frame, by its range cells, sub-columns, rays per cell and passes, twice where an antenna is not
// upright and a column may meet every range twice: an echo takes some 100
// bytes, and as much again while the sub-columns are put together.
inline constexpr double kMostFrameEchoRays = 2e7;

struct FrameEchoSettings {
  // Used of it: sub_columns, rays_per_cell, largest_step_rad, largest_step_rows.
  Sampling sampling;
  int passes = 1;             // rays in each cut, 1 to 64
  double half_fan_rad = 0.0;  // to either side of boresight; 0: all that the picture's beam reaches
  glm::dvec3 own_velocity_mps{0.0};       // of the antenna, in scene axes
  Multipath multipath = Multipath::none;  // of point targets
  // Targets fluctuate: of cases 1 and 3 from frame to frame, of 2 and 4 from look to look.
  bool swerling = false;
  std::uint64_t seed = 0;
  std::uint32_t look = 0;  // of the frame: places and phases of its own
};

// What a look's own draws begin with: far apart, so that no two runs of neighbouring seeds share a look.
constexpr std::uint64_t seed_of_look(std::uint64_t seed, std::uint32_t look) {
  return seed + look * std::uint64_t{0x9E3779B97F4A7C15U};
}

struct FrameEchoes {
  // Surfaces from left to right and from below, then the targets in their order. `object_id` is
  // the geometry's number for a surface, the target's index for a target.
  std::vector<core::Echo> echoes;
  std::vector<double> phase_rad;  // of each, in [0, 2 pi)
  std::size_t first_target = 0;   // the echoes from here on are point targets
  std::uint64_t rays = 0;
  // "below_terrain": the antenna is not above the ground, and there are no echoes. As in frame.h.
  std::vector<std::string> events;
};

// Echoes inside the sensor's range gate with power above 0. Throws InputError: E-NONFINITE for a
// velocity that is not finite, E-RANGE for passes and a half fan (0 to pi) out of range, E-LIMIT
// above kMostFrameEchoRays, and what check(FramePose) throws.
FrameEchoes frame_echoes(const World& world, const FramePose& pose,
                         const FrameEchoSettings& settings);

}  // namespace fanbeam::renderer
