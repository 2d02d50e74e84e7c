#include <algorithm>
#include <vector>

#include "terrain/buildings/crossings_private.h"

namespace fanbeam::terrain {
namespace {

constexpr std::size_t kMostComparisons = 100'000'000;

struct Edge {
  OGRRawPoint a, b;
  std::size_t ring = 0, place = 0, ring_edges = 0;

  double west() const { return std::min(a.x, b.x); }
  double east() const { return std::max(a.x, b.x); }
};

bool are_neighbours(const Edge& p, const Edge& q) {
  if (p.ring != q.ring) return false;
  const std::size_t apart = p.place > q.place ? p.place - q.place : q.place - p.place;
  return apart <= 1 || apart == p.ring_edges - 1;
}

// Twice the area of the triangle: which side of the edge the point lies on.
double side(const Edge& edge, const OGRRawPoint& p) {
  return (edge.b.x - edge.a.x) * (p.y - edge.a.y) - (edge.b.y - edge.a.y) * (p.x - edge.a.x);
}

// Touching counts; rounding may add or lose a pair that nearly does.
bool meet(const Edge& p, const Edge& q) {
  if (std::max(p.a.y, p.b.y) < std::min(q.a.y, q.b.y)) return false;
  if (std::max(q.a.y, q.b.y) < std::min(p.a.y, p.b.y)) return false;
  return side(p, q.a) * side(p, q.b) <= 0.0 && side(q, p.a) * side(q, p.b) <= 0.0;
}

std::vector<Edge> edges_from_west(const OGRPolygon& polygon) {
  std::vector<Edge> edges;
  std::size_t ring_number = 0;
  for (const OGRLinearRing* ring : polygon) {
    const int points = ring->getNumPoints();
    for (int i = 0; i + 1 < points; ++i)
      edges.push_back({{ring->getX(i), ring->getY(i)},
                       {ring->getX(i + 1), ring->getY(i + 1)},
                       ring_number,
                       static_cast<std::size_t>(i),
                       static_cast<std::size_t>(points - 1)});
    ++ring_number;
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& p, const Edge& q) { return p.west() < q.west(); });
  return edges;
}

}  // namespace

std::size_t crossings(const OGRPolygon& polygon, std::size_t most) {
  const std::vector<Edge> edges = edges_from_west(polygon);
  std::size_t found = 0;
  std::size_t comparisons = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size() && edges[k].west() <= edges[i].east(); ++k) {
      if (++comparisons > kMostComparisons) return most;
      if (are_neighbours(edges[i], edges[k]) || !meet(edges[i], edges[k])) continue;
      if (++found == most) return most;
    }
  }
  return found;
}

}  // namespace fanbeam::terrain
