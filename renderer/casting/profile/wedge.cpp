#include "renderer/casting/profile/wedge.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fanbeam::renderer {
namespace {

// A wall nearer than this to a direction stands edge on.
constexpr double kEdgeOn_rad = 1e-9;

double facet_m(const CutEdge& edge) {
  return std::abs(edge.cross_m2) / glm::length(edge.to_m - edge.from_m);
}

// Where the half-plane along the unit vector `along` meets an edge that spans its heading.
double crossing_m(const CutEdge& edge, const glm::dvec2& along) {
  const glm::dvec2 step_m = edge.to_m - edge.from_m;
  const double across = along.x * step_m.y - along.y * step_m.x;
  if (across * across <= kEdgeOn_rad * kEdgeOn_rad * glm::dot(step_m, step_m))
    return glm::length(edge.from_m);
  const double distance_m = edge.cross_m2 / across;
  const double far2_m2 =
      std::max(glm::dot(edge.from_m, edge.from_m), glm::dot(edge.to_m, edge.to_m));
  if (distance_m > 0.0 && distance_m * distance_m <= far2_m2) return distance_m;
  return std::clamp(distance_m, facet_m(edge), std::max(std::sqrt(far2_m2), facet_m(edge)));
}

}  // namespace

Wedge::Wedge(const Slice& slice)
    : slice_(slice),
      range_{slice.heading_rad - slice.width_rad / 2, slice.heading_rad + slice.width_rad / 2} {
  const double cosine = std::cos(slice.width_rad / 2), sine = std::sin(slice.width_rad / 2);
  const glm::dvec2 clockwise(slice.along.y, -slice.along.x);
  left_ = slice.along * cosine - clockwise * sine;
  right_ = slice.along * cosine + clockwise * sine;
}

// Most walls span the wedge: its own directions are at hand.
glm::dvec2 Wedge::toward(double heading_rad) const {
  if (heading_rad == slice_.heading_rad) return slice_.along;
  if (heading_rad == range_.left_rad) return left_;
  if (heading_rad == range_.right_rad) return right_;
  const double beside_rad = heading_rad - slice_.heading_rad, square = beside_rad * beside_rad;
  // Of a narrow wedge to 1e-13 by the series.
  constexpr double kNarrow = 1e-4;
  const double tangent = square < kNarrow
                             ? beside_rad * (1.0 + square * (1.0 / 3 + square * (2.0 / 15)))
                             : std::tan(beside_rad);
  const glm::dvec2 clockwise(slice_.along.y, -slice_.along.x);
  return (slice_.along + clockwise * tangent) / std::sqrt(1.0 + tangent * tangent);
}

double Wedge::distance_m(const CutEdge& edge, const HeadingRange& part) const {
  const bool whole = part.left_rad == range_.left_rad && part.right_rad == range_.right_rad;
  return crossing_m(edge, whole ? slice_.along : toward(part.middle_rad()));
}

WallPart Wedge::wall(const CutEdge& edge, const HeadingRange& part) const {
  WallPart wall;
  wall.distance_m = distance_m(edge, part);
  const double left_m = crossing_m(edge, toward(part.left_rad)) - wall.distance_m;
  const double right_m = crossing_m(edge, toward(part.right_rad)) - wall.distance_m;
  wall.nearer_m = std::min({left_m, right_m, 0.0});
  wall.farther_m = std::max({left_m, right_m, 0.0});
  wall.right_nearer = right_m < left_m;
  wall.facet_m = facet_m(edge);
  return wall;
}

}  // namespace fanbeam::renderer
