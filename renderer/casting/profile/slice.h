// One azimuth half-plane of a frame and what is seen in it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace fanbeam::renderer {

// A vertical half-plane from the sensor's place, standing for the wedge of `width_rad` around it.
struct Slice {
  glm::dvec2 along{0.0, 1.0};  // unit vector
  double heading_rad = 0.0;    // clockwise from the antenna's forward axis
  double width_rad = 0.0;
};

// Straight visible pieces of the profile, side by side for the vector units. Distances are
// horizontal from the sensor, heights relative to it. Each piece lies on a plane facet; `in_plane`
// and `facet` are the distances of the sensor from the piece's line inside the half-plane and from
// the facet's plane, as quotients n / sqrt(d2) whose roots are left to the vector loop.
struct VisiblePieces {
  static constexpr int kCapacity = 256;
  template <class T>
  using Column = std::array<T, kCapacity>;

  alignas(64) Column<double> near_distance_m, near_height_m, far_distance_m, far_height_m;
  alignas(64) Column<double> in_plane_n_m, in_plane_d2, facet_n_m, facet_d2;
  // Walls: how much nearer and farther the facet lies at the wedge's borders.
  alignas(64) Column<double> nearer_m, farther_m;
  alignas(64) Column<std::int32_t> material;
  int count = 0;

  bool full() const { return count == kCapacity; }
};

}  // namespace fanbeam::renderer
