// The ray-casting library against double precision, over the very rays of a frame.
//
// The ray caster takes the library's hit distance, a float, for the range. Worked out in double it
// is t = n.(v - o) / n.d, with the antenna's place o, the ray's direction d (as it was sent, made a
// unit vector in double), a corner v of the triangle that was hit and its normal n. The difference
// holds the rounding of the antenna's place, of the corners and of the library's arithmetic; what
// rounding the direction does is another ray, not another range.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "measure/figures.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame_pose.h"
#include "renderer/world.h"
#include "terrain/ray_scene.h"

namespace fanbeam::measure {

class RangeCheck {
 public:
  // The rays of a frame at `sampling`, one of the ray caster's. `world` must outlive the check.
  RangeCheck(const renderer::World& world, const renderer::FramePose& pose,
             const renderer::Sampling& sampling);

  // Errors of the float range. Times: all rays cast, and cast with their ranges worked out in
  // double, on all threads; nothing else of a frame.
  RangeFigures ranges(int repetitions) const;

  // Of the same rays against `other`, which holds the same surfaces.
  RobustFigures against(const terrain::RayScene& other) const;

 private:
  const renderer::World& world_;
  glm::dvec3 antenna_m_;
  std::vector<terrain::RayPacket<16>> packets_;
};

}  // namespace fanbeam::measure
