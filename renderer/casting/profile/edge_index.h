// Which vertical walls and painted borders each slice of a frame crosses.
//
// All edges near enough are seen from the sensor once per frame: the azimuths of their ends decide
// which slices cross them, the same way for both edges that share a corner, so that a slice enters
// and leaves every building as often. Edges come roughly from near to far.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/world.h"

namespace fanbeam::renderer {

struct CutEdge {
  static constexpr std::uint32_t kPaint = 0xFFFFFFFFU;
  glm::dvec2 from_m, to_m;  // relative to the sensor
  double from_rad, to_rad;  // clockwise from the forward axis
  double cross_m2;          // of from and to
  std::uint32_t prism;      // index into Solids::prisms, or kPaint
  // Steps to the ring's edges that end where this one begins and begin where it ends; 0 where they
  // are out of view.
  std::int32_t before = 0, after = 0;
};

class EdgeIndex {
 public:
  // `headings_rad` of the frame's slices, rising; `tile` slices share a list of candidates.
  // `forward` is the horizontal direction of heading 0.
  EdgeIndex(const World& world, const glm::dvec2& sensor_m, const glm::dvec2& forward,
            const std::vector<double>& headings_rad, std::size_t tile);

  // Indices into edges() that a slice of the tile may cross, roughly from near to far.
  struct Candidates {
    const std::uint32_t* first;
    const std::uint32_t* last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };
  Candidates candidates(std::size_t tile) const {
    return {edge_of_tile_.data() + tile_begin_[tile], edge_of_tile_.data() + tile_begin_[tile + 1]};
  }
  const std::vector<CutEdge>& edges() const { return edges_; }
  // Prisms that the sensor stands above.
  const std::vector<std::uint32_t>& below_sensor() const { return below_sensor_; }

 private:
  std::vector<CutEdge> edges_;
  std::vector<std::size_t> tile_begin_;
  std::vector<std::uint32_t> edge_of_tile_;
  std::vector<std::uint32_t> below_sensor_;
};

}  // namespace fanbeam::renderer
