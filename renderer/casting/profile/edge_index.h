// Which vertical walls and painted borders stand in the wedge of each slice of a frame.
//
// All edges near enough are seen from the sensor once per frame: the azimuths of their ends decide
// which wedges they reach into, the same way for both edges that share a corner, so that each
// heading enters and leaves every building as often. Edges come roughly from near to far.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/casting/profile/slice.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

struct CutEdge {
  static constexpr std::uint32_t kPaint = 0xFFFFFFFFU;
  glm::dvec2 from_m, to_m;  // relative to the sensor
  double from_rad, to_rad;  // clockwise from the forward axis
  double cross_m2;          // of from and to
  // At most that of anything of its building: where the horizon is higher, there is none of it.
  double highest_tangent;
  std::uint32_t prism;  // index into Solids::prisms, or kPaint
};

// A ring of a building or of paint, the same in all frames.
struct PlanRing {
  glm::dvec2 low_m, high_m;  // bounds of the whole building
  double top_m;
  const std::vector<glm::dvec2>* corners_m;
  std::uint32_t prism;  // as in CutEdge
};
// Of one prism one after the other. `world` must outlive them.
std::vector<PlanRing> plan_rings(const World& world);

class EdgeIndex {
 public:
  // Rings up to `far_m`; the frame's `slices` by rising heading, of which `tile` share a list of
  // candidates. `forward` is the horizontal direction of heading 0.
  EdgeIndex(const std::vector<PlanRing>& rings, double far_m, const glm::dvec3& sensor_m,
            const glm::dvec2& forward, const std::vector<Slice>& slices, std::size_t tile);

  // What may stand in the tile's wedges, roughly from near to far.
  struct Candidates {
    const CutEdge* const* first;
    const CutEdge* const* last;
    const CutEdge* const* begin() const { return first; }
    const CutEdge* const* end() const { return last; }
  };
  Candidates candidates(std::size_t tile) const {
    return {edge_of_tile_.data() + tile_begin_[tile], edge_of_tile_.data() + tile_begin_[tile + 1]};
  }
  // Prisms that the sensor stands above.
  const std::vector<std::uint32_t>& below_sensor() const { return below_sensor_; }

 private:
  std::vector<std::vector<CutEdge>> edges_;  // of blocks of rings
  std::vector<std::size_t> tile_begin_;
  std::vector<const CutEdge*> edge_of_tile_;
  std::vector<std::uint32_t> below_sensor_;
};

}  // namespace fanbeam::renderer
