// Directions seen from above.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace fanbeam::renderer {

// Unit vector of where `direction` heads; north for one that is upright.
inline glm::dvec2 horizontal(const glm::dvec3& direction) {
  const glm::dvec2 flat(direction.x, direction.y);
  const double length = glm::length(flat);
  return length > 1e-9 ? flat / length : glm::dvec2(0.0, 1.0);
}

// From one direction to another, positive clockwise, in (-pi, pi].
inline double turn_rad(const glm::dvec2& from, const glm::dvec2& to) {
  return std::atan2(from.y * to.x - from.x * to.y, glm::dot(from, to));
}

// Of a heading, what lies so far clockwise of it.
inline glm::dvec2 turned(const glm::dvec2& from, double clockwise_rad) {
  const double c = std::cos(clockwise_rad), s = std::sin(clockwise_rad);
  return {from.x * c + from.y * s, from.y * c - from.x * s};
}

}  // namespace fanbeam::renderer
