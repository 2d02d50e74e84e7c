#include "atmosphere/precipitation/vertical_prism.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fanbeam::atmosphere {

// The part of a path, from 0 to 1, that is still inside.
struct VerticalPrism::Interval {
  double from = 0.0, to = 1.0;

  // Keeps what lies between two walls for a coordinate that goes from `start` to `start + change`.
  // Along the walls the lower one belongs to the inside.
  void clip(double start, double change, double low, double high) noexcept {
    if (change == 0.0) {
      if (!(start >= low && start < high)) to = from;
      return;
    }
    const double a = (low - start) / change;
    const double b = (high - start) / change;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }

  void clip_circle(const glm::dvec2& start, const glm::dvec2& change, double radius) noexcept {
    const double square = glm::dot(change, change);
    if (square == 0.0) {
      if (!(glm::dot(start, start) < radius * radius)) to = from;
      return;
    }
    const double cross = start.x * change.y - start.y * change.x;
    const double discriminant = radius * radius * square - cross * cross;
    if (!(discriminant > 0.0)) {
      to = from;
      return;
    }
    const double middle = -glm::dot(start, change);
    const double half = std::sqrt(discriminant);
    from = std::max(from, (middle - half) / square);
    to = std::min(to, (middle + half) / square);
  }
};

namespace {

glm::dvec2 to_the_right(const glm::dvec2& along) noexcept { return {along.y, -along.x}; }

}  // namespace

VerticalPrism VerticalPrism::circular(glm::dvec2 centre_m, double radius_m, double base_m,
                                      double top_m) {
  VerticalPrism prism;
  prism.centre_m_ = centre_m;
  prism.radius_m_ = radius_m;
  prism.base_m_ = base_m;
  prism.top_m_ = top_m;
  return prism;
}

VerticalPrism VerticalPrism::rectangular(glm::dvec2 centre_m, double length_m, double width_m,
                                         double heading_rad, double base_m, double top_m) {
  VerticalPrism prism;
  prism.centre_m_ = centre_m;
  prism.along_ = {std::sin(heading_rad), std::cos(heading_rad)};
  prism.half_m_ = {length_m / 2, width_m / 2};
  prism.base_m_ = base_m;
  prism.top_m_ = top_m;
  return prism;
}

bool VerticalPrism::contains(const glm::dvec3& position_m) const noexcept {
  if (!(position_m.z >= base_m_ && position_m.z < top_m_)) return false;
  const glm::dvec2 relative = glm::dvec2(position_m) - centre_m_;
  if (radius_m_ > 0.0) return glm::dot(relative, relative) < radius_m_ * radius_m_;
  const double ahead = glm::dot(relative, along_);
  const double right = glm::dot(relative, to_the_right(along_));
  return ahead >= -half_m_.x && ahead < half_m_.x && right >= -half_m_.y && right < half_m_.y;
}

double VerticalPrism::chord_m(const glm::dvec3& from_m, const glm::dvec3& to_m) const noexcept {
  const glm::dvec3 change = to_m - from_m;
  Interval inside;
  inside.clip(from_m.z, change.z, base_m_, top_m_);
  if (!(inside.to > inside.from)) return 0.0;
  clip_to_footprint(glm::dvec2(from_m), glm::dvec2(change), inside);
  return std::max(0.0, inside.to - inside.from) * glm::length(change);
}

bool VerticalPrism::stands_between(const glm::dvec2& from_m,
                                   const glm::dvec2& to_m) const noexcept {
  Interval inside;
  clip_to_footprint(from_m, to_m - from_m, inside);
  return inside.to > inside.from;
}

void VerticalPrism::clip_to_footprint(const glm::dvec2& from_m, const glm::dvec2& change_m,
                                      Interval& inside) const noexcept {
  const glm::dvec2 start = from_m - centre_m_;
  if (radius_m_ > 0.0) {
    inside.clip_circle(start, change_m, radius_m_);
  } else {
    const glm::dvec2 right = to_the_right(along_);
    inside.clip(glm::dot(start, along_), glm::dot(change_m, along_), -half_m_.x, half_m_.x);
    inside.clip(glm::dot(start, right), glm::dot(change_m, right), -half_m_.y, half_m_.y);
  }
}

double VerticalPrism::longest_chord_m() const noexcept {
  const double across_m = radius_m_ > 0.0 ? 2.0 * radius_m_ : 2.0 * glm::length(half_m_);
  return std::hypot(across_m, top_m_ - base_m_);
}

}  // namespace fanbeam::atmosphere
