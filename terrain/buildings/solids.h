// The one model of buildings that both casters see: clean prisms on the ground.
//
// The ray caster sees them as the triangles that `extrude` makes of them, the profile caster cuts
// the very same rings. What a vertical cut from above cannot describe (models, prisms with air
// under them) is not here: only the box around each of them is, so that the azimuths they stand in
// can be left to rays.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/height_field.h"

namespace fanbeam::terrain {

struct Solid {
  // The first ring is the outline, counter-clockwise seen from above, the others are courtyards,
  // clockwise: the building lies on the left of every edge. The last point is not the first again.
  std::vector<std::vector<glm::dvec2>> rings_m;
  double top_m = 0.0;
  MaterialId wall = 0;
  MaterialId roof = 0;
  ObjectId object = kTerrainObject;
};

struct Box_m {
  glm::dvec3 low{0.0};
  glm::dvec3 high{0.0};
};

struct Solids {
  // Solid from below the ground to `top_m`; they may overlap. A wall that crosses a dip deeper than
  // its foundation ends in the air for rays, in the ground here.
  std::vector<Solid> prisms;
  std::vector<Box_m> others;  // bounds of all other geometry above the ground
};

}  // namespace fanbeam::terrain
