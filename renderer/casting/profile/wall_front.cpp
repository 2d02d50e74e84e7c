#include "renderer/casting/profile/wall_front.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fanbeam::renderer {
namespace {

// A wall nearer than this to the slice's own direction stands edge on.
constexpr double kEdgeOn_rad = 1e-9;

// An edge as a line from the sensor's point of view.
class WallLine {
 public:
  explicit WallLine(const CutEdge& edge)
      : edge_(edge),
        step_m_(edge.to_m - edge.from_m),
        length_m_(glm::length(step_m_)),
        from_m_(glm::length(edge.from_m)),
        to_m_(glm::length(edge.to_m)) {}

  double from_m() const { return from_m_; }
  double to_m() const { return to_m_; }
  // Of the line from the sensor.
  double facet_m() const { return std::abs(edge_.cross_m2) / length_m_; }
  double crossing_m(const glm::dvec2& along) const {
    const double across = along.x * step_m_.y - along.y * step_m_.x;
    if (std::abs(across) <= kEdgeOn_rad * length_m_) return from_m_;
    return std::clamp(edge_.cross_m2 / across, facet_m(), std::max({from_m_, to_m_, facet_m()}));
  }

 private:
  const CutEdge& edge_;
  glm::dvec2 step_m_;
  double length_m_, from_m_, to_m_;
};

bool faces_sensor(const CutEdge& edge) { return edge.from_rad < edge.to_rad; }

// Of a part: a corner of the wall or a border of the wedge.
struct PartEnd {
  glm::dvec2 along;
  double distance_m;
};

glm::dvec2 between(const PartEnd& left, const PartEnd& right) {
  constexpr double kOpposite = 1e-9;
  const glm::dvec2 sum = left.along + right.along;
  const double length = glm::length(sum);
  return length > kOpposite ? sum / length : left.along;
}

// What of `edge` lies between two headings; beyond its corners there is none of it.
WallPart part_between(const CutEdge& edge, const Wedge& wedge, double left_rad, double right_rad,
                      double share) {
  const WallLine line(edge);
  const PartEnd left = edge.from_rad >= left_rad
                           ? PartEnd{edge.from_m / line.from_m(), line.from_m()}
                           : PartEnd{wedge.left, line.crossing_m(wedge.left)};
  const PartEnd right = edge.to_rad <= right_rad
                            ? PartEnd{edge.to_m / line.to_m(), line.to_m()}
                            : PartEnd{wedge.right, line.crossing_m(wedge.right)};
  WallPart part;
  part.distance_m = line.crossing_m(between(left, right));
  part.nearer_m =
      std::min({left.distance_m - part.distance_m, right.distance_m - part.distance_m, 0.0});
  part.farther_m =
      std::max({left.distance_m - part.distance_m, right.distance_m - part.distance_m, 0.0});
  part.facet_m = line.facet_m();
  part.share = share;
  return part;
}

// Which way to go along a front: at a wall's end on that side, and on to the next wall.
struct Side {
  double CutEdge::*end_rad;
  std::int32_t CutEdge::*next;
  double sign;
};
constexpr Side kLeft{&CutEdge::from_rad, &CutEdge::before, -1.0};
constexpr Side kRight{&CutEdge::to_rad, &CutEdge::after, 1.0};

// The last wall of the front to one side, as far as another slice cuts it.
struct FrontEnd {
  std::int64_t edge;
  double beside_rad;  // of the slice, where it ends; from the wedge's width up: anywhere beyond
  int walls;          // on the way there
};

FrontEnd front_end(const std::vector<CutEdge>& edges, std::int64_t edge, const Slice& slice,
                   const Side& side) {
  for (int walls = 0;; ++walls) {
    const CutEdge& here = edges[static_cast<std::size_t>(edge)];
    const double beside_rad = side.sign * (here.*side.end_rad - slice.heading_rad);
    const std::int32_t step = here.*side.next;
    if (walls > WallFront::kMostAside || beside_rad >= slice.width_rad || step == 0 ||
        !faces_sensor(edges[static_cast<std::size_t>(edge + step)]))
      return {edge, beside_rad, walls};
    edge += step;
  }
}

}  // namespace

Wedge::Wedge(const Slice& of) : slice(of) {
  const double cosine = std::cos(of.width_rad / 2), sine = std::sin(of.width_rad / 2);
  const glm::dvec2 clockwise(of.along.y, -of.along.x);
  left = of.along * cosine - clockwise * sine;
  right = of.along * cosine + clockwise * sine;
}

double crossing_m(const CutEdge& edge, const glm::dvec2& along) {
  return WallLine(edge).crossing_m(along);
}

void wall_in_wedge(const CutEdge& edge, const Wedge& wedge, WallFront& front) {
  const double heading_rad = wedge.slice.heading_rad, half_rad = wedge.slice.width_rad / 2;
  front.parts[0] = part_between(edge, wedge, heading_rad - half_rad, heading_rad + half_rad, 1.0);
  front.count = 1;
}

void front_of(const std::vector<CutEdge>& edges, std::uint32_t edge, const Wedge& wedge,
              WallFront& front) {
  const double heading_rad = wedge.slice.heading_rad, width_rad = wedge.slice.width_rad;
  const FrontEnd left = front_end(edges, edge, wedge.slice, kLeft);
  const FrontEnd right = front_end(edges, edge, wedge.slice, kRight);
  if (std::max(left.walls, right.walls) > WallFront::kMostAside) {
    wall_in_wedge(edges[edge], wedge, front);
    return;
  }
  const auto reach_rad = [width_rad](const FrontEnd& end) {
    return end.beside_rad < width_rad ? end.beside_rad : width_rad / 2;
  };
  const double left_rad = heading_rad - reach_rad(left);
  const double right_rad = heading_rad + reach_rad(right);
  const double per_rad = 1.0 / std::min(width_rad, left.beside_rad + right.beside_rad);
  front.count = 0;
  for (std::int64_t e = left.edge;; e += edges[static_cast<std::size_t>(e)].after) {
    const CutEdge& wall = edges[static_cast<std::size_t>(e)];
    const double span_rad = std::min(wall.to_rad, right_rad) - std::max(wall.from_rad, left_rad);
    if (span_rad > 0.0)
      front.parts[static_cast<std::size_t>(front.count++)] =
          part_between(wall, wedge, left_rad, right_rad, span_rad * per_rad);
    if (e == right.edge) break;
  }
}

}  // namespace fanbeam::renderer
