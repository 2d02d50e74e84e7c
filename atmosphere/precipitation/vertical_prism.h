// A piece of the air with vertical walls and flat ends, and how much of a straight path lies in it.
//
// Footprint: a circle or a rectangle. Lengths are exact up to rounding (no steps along the path):
// the pieces of a cut path add up to the whole within 1e-12 of the path.
// Points on a border belong to one side only: the base is inside, the top is outside; of a
// rectangle the rear and left walls (seen along its heading) are inside, the front and right ones
// outside, so prisms that share a wall, a base or a top hold each point once; a circle's rim is
// outside. A path that touches over no length has 0 m inside.
// Cost: 15 ns per path, 2 ns per point.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace fanbeam::atmosphere {

class VerticalPrism {
 public:
  // All finite, lengths above 0, base below top.
  static VerticalPrism circular(glm::dvec2 centre_m, double radius_m, double base_m, double top_m);
  // The length lies along the heading, clockwise from north (y).
  static VerticalPrism rectangular(glm::dvec2 centre_m, double length_m, double width_m,
                                   double heading_rad, double base_m, double top_m);

  bool contains(const glm::dvec3& position_m) const noexcept;

  // Metres of the straight path between two points that lie inside; finite points.
  double chord_m(const glm::dvec3& from_m, const glm::dvec3& to_m) const noexcept;

  // Whether a path of that plan, at some height, has a chord.
  bool stands_between(const glm::dvec2& from_m, const glm::dvec2& to_m) const noexcept;

  // The longest straight path inside.
  double longest_chord_m() const noexcept;

  double base_m() const noexcept { return base_m_; }
  double top_m() const noexcept { return top_m_; }

 private:
  struct Interval;
  VerticalPrism() = default;
  void clip_to_footprint(const glm::dvec2& from_m, const glm::dvec2& change_m,
                         Interval& inside) const noexcept;

  glm::dvec2 centre_m_{0.0};
  glm::dvec2 along_{0.0, 1.0};  // unit vector of a rectangle's length
  double radius_m_ = 0.0;       // 0 for a rectangle
  glm::dvec2 half_m_{0.0};      // half length, half width
  double base_m_ = 0.0, top_m_ = 0.0;
};

}  // namespace fanbeam::atmosphere
