// One azimuth half-plane of a frame and what is seen in it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "terrain/height_field.h"

namespace fanbeam::renderer {

// A vertical half-plane from the sensor's place, standing for the wedge of `width_rad` around it.
struct Slice {
  glm::dvec2 along{0.0, 1.0};  // unit vector
  double heading_rad = 0.0;    // clockwise from the antenna's forward axis
  double width_rad = 0.0;
};

// Straight visible pieces of the profile, side by side for the vector units. Distances are
// horizontal from the sensor, heights relative to it. Each piece lies on a plane facet, whose plane
// passes the sensor at `facet_m` / sqrt(facet_d2): the root is left to the vector loop.
struct VisiblePieces {
  static constexpr int kCapacity = 128;
  template <class T>
  using Column = std::array<T, kCapacity>;

  alignas(64) Column<double> near_distance_m, near_height_m, far_distance_m, far_height_m;
  // Twice the area of the triangle between the sensor and the piece, positive when it faces there.
  alignas(64) Column<double> cross_m2;
  alignas(64) Column<double> facet_m, facet_d2;
  alignas(64) Column<std::int32_t> material;
  alignas(64) Column<terrain::ObjectId> object;
  // Walls: how much nearer and farther the facet lies at the wedge's borders; 0 elsewhere.
  alignas(64) Column<double> nearer_m, farther_m;
  // Of the wedge, what the piece stands for and what lies left of that: 1 and 0 beside buildings.
  alignas(64) Column<double> share, left;
  alignas(64) Column<std::int32_t> right_nearer;  // of an oblique wall's ends: 1 or 0

  int count = 0;
  bool full() const { return count == kCapacity; }
};

// Elevation that one piece may span: pattern, range and, under a tilted antenna, azimuth are those
// of its middle. Of a beam narrower than 7.3 deg a part of its width: on its flanks the pattern bends.
inline double most_elevation_rad(double half_power_width_rad) {
  return std::min(0.002, half_power_width_rad / 64.0);
}

// Into how many parts a piece goes, from its cross product, at least 0, and the square of its nearest
// range.
inline int parts_of(double cross_m2, double nearest2_m2, double most_rad) {
  constexpr double kMostParts = 1000.0;
  const double one_m2 = most_rad * nearest2_m2;  // 0 for a cell that begins at the sensor
  return 1 + static_cast<int>(cross_m2 < kMostParts * one_m2 ? cross_m2 / one_m2 : kMostParts);
}

}  // namespace fanbeam::renderer
