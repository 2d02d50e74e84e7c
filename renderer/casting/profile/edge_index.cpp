#include "renderer/casting/profile/edge_index.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "core/parallel.h"

namespace fanbeam::renderer {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// One view from above: what of a ring the slices between two headings can meet.
class PlanView {
 public:
  PlanView(const glm::dvec2& sensor_m, const glm::dvec2& forward, double left_rad, double right_rad,
           double far_m)
      : sensor_m_(sensor_m),
        forward_(forward),
        right_(forward.y, -forward.x),
        left_rad_(left_rad),
        right_rad_(right_rad),
        far_m_(far_m) {}

  // Appends the ring's edges in view. True when the sensor stands inside the ring.
  bool add_ring(const std::vector<glm::dvec2>& ring_m, std::uint32_t prism,
                std::vector<CutEdge>& edges) const {
    const glm::dvec2 box = ring_m.front() - sensor_m_;
    glm::dvec2 low = box, high = box;
    for (const glm::dvec2& corner : ring_m) {
      low = glm::min(low, corner - sensor_m_);
      high = glm::max(high, corner - sensor_m_);
    }
    const bool around = low.x <= 0.0 && low.y <= 0.0 && high.x >= 0.0 && high.y >= 0.0;
    const glm::dvec2 nearest = glm::clamp(glm::dvec2(0.0), low, high);
    if (glm::dot(nearest, nearest) > far_m_ * far_m_) return false;
    if (!around && behind(low, high)) return false;
    double turned_rad = 0.0;
    glm::dvec2 from = ring_m.back() - sensor_m_;
    double from_rad = heading_rad(from);
    const std::size_t begin = edges.size();
    bool seen_before = false, seen_first = false;
    for (const glm::dvec2& corner : ring_m) {
      const glm::dvec2 to = corner - sensor_m_;
      const double to_rad = heading_rad(to);
      turned_rad += std::remainder(to_rad - from_rad, 2.0 * core::kPi);
      // Edges that pass behind the sensor cross the jump of the heading, far from any slice.
      const bool seen = std::abs(to_rad - from_rad) < core::kPi &&
                        std::max(from_rad, to_rad) >= left_rad_ &&
                        std::min(from_rad, to_rad) <= right_rad_;
      if (seen) {
        edges.push_back({from, to, from_rad, to_rad, cross(from, to), prism});
        if (seen_before) join(edges[edges.size() - 2], edges.back(), 1);
      }
      if (&corner == &ring_m.front()) seen_first = seen;
      seen_before = seen;
      from = to;
      from_rad = to_rad;
    }
    if (seen_first && seen_before && edges.size() > begin + 1)
      join(edges.back(), edges[begin], -static_cast<std::int32_t>(edges.size() - 1 - begin));
    return std::abs(turned_rad) > core::kPi;
  }

 private:
  static void join(CutEdge& edge, CutEdge& next, std::int32_t steps) {
    edge.after = steps;
    next.before = -steps;
  }
  double heading_rad(const glm::dvec2& relative_m) const {
    return std::atan2(glm::dot(relative_m, right_), glm::dot(relative_m, forward_));
  }
  // The whole box lies outside the sector; only sure for sectors narrower than a half-turn.
  bool behind(const glm::dvec2& low, const glm::dvec2& high) const {
    const auto all_left_of = [&](double rad, double sign) {
      const glm::dvec2 ray = forward_ * std::cos(rad) + right_ * std::sin(rad);
      for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
        if (sign * cross(ray, at) <= 0.0) return false;
      }
      return true;
    };
    const bool narrow = right_rad_ - left_rad_ < core::kPi;
    return narrow && (all_left_of(left_rad_, 1.0) || all_left_of(right_rad_, -1.0));
  }

  glm::dvec2 sensor_m_, forward_, right_;
  double left_rad_, right_rad_, far_m_;
};

// In which tile of slices a heading lies: the first slice that is not left of it.
class TileFinder {
 public:
  TileFinder(const std::vector<double>& headings_rad, std::size_t tile)
      : headings_rad_(headings_rad),
        tile_(tile),
        last_tile_((headings_rad.size() - 1) / tile),
        per_rad_(headings_rad.size() > 1 ? static_cast<double>(headings_rad.size() - 1) /
                                               (headings_rad.back() - headings_rad.front())
                                         : 0.0) {}

  std::size_t tiles() const { return last_tile_ + 1; }
  std::uint32_t operator()(double heading_rad) const {
    // Headings are nearly even: a guess is right or next to it.
    const double guess = (heading_rad - headings_rad_.front()) * per_rad_;
    const auto most = static_cast<double>(headings_rad_.size());
    auto slice = static_cast<std::size_t>(std::clamp(guess, 0.0, most));
    while (slice > 0 && headings_rad_[slice - 1] >= heading_rad) --slice;
    while (slice < headings_rad_.size() && headings_rad_[slice] < heading_rad) ++slice;
    return static_cast<std::uint32_t>(std::min(slice / tile_, last_tile_));
  }

 private:
  const std::vector<double>& headings_rad_;
  std::size_t tile_, last_tile_;
  double per_rad_;
};

// Where an edge goes: the tiles that it spans, and its middle's distance in steps.
struct EdgePlace {
  std::uint32_t first_tile, last_tile;
  std::uint32_t distance_step;
};
constexpr std::size_t kDistanceSteps = 512;

EdgePlace place_of(const CutEdge& edge, const TileFinder& tile_of, double far_m) {
  const double share = glm::length(edge.from_m + edge.to_m) / 2 / far_m;
  return {tile_of(std::min(edge.from_rad, edge.to_rad)),
          tile_of(std::max(edge.from_rad, edge.to_rad)),
          static_cast<std::uint32_t>(std::min(share * kDistanceSteps, kDistanceSteps - 1.0))};
}

// Numbers of the edges in the order of their distance steps: a counting sort.
std::vector<std::uint32_t> by_distance(const std::vector<EdgePlace>& places) {
  std::vector<std::size_t> begin(kDistanceSteps + 1, 0);
  for (const EdgePlace& place : places) ++begin[place.distance_step + 1U];
  for (std::size_t b = 0; b < kDistanceSteps; ++b) begin[b + 1] += begin[b];
  std::vector<std::uint32_t> order(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    order[begin[places[i].distance_step]++] = static_cast<std::uint32_t>(i);
  return order;
}

// What a block of prisms has in view.
struct Found {
  std::vector<CutEdge> edges;
  std::vector<std::uint32_t> below_sensor;
};

Found edges_of_prisms(const std::vector<terrain::Solid>& prisms, std::size_t begin, std::size_t end,
                      const PlanView& view) {
  Found found;
  for (std::size_t i = begin; i < end; ++i) {
    const auto prism = static_cast<std::uint32_t>(i);
    bool inside = false;
    for (const auto& ring : prisms[i].rings_m)
      if (view.add_ring(ring, prism, found.edges)) inside = !inside;
    if (inside) found.below_sensor.push_back(prism);
  }
  return found;
}

}  // namespace

EdgeIndex::EdgeIndex(const World& world, const glm::dvec2& sensor_m, const glm::dvec2& forward,
                     const std::vector<double>& headings_rad, std::size_t tile) {
  const double far_m = world.sensor.range.maximum_m();
  const PlanView view(sensor_m, forward, headings_rad.front(), headings_rad.back(), far_m);
  const std::vector<terrain::Solid>& prisms = world.solids.prisms;
  constexpr std::size_t kAtOnce = 256;
  const std::size_t blocks = (prisms.size() + kAtOnce - 1) / kAtOnce;
  std::vector<Found> found(blocks + 1);
  core::parallel_for(blocks, [&](std::size_t block) {
    const std::size_t begin = block * kAtOnce;
    found[block] = edges_of_prisms(prisms, begin, std::min(begin + kAtOnce, prisms.size()), view);
  });
  if (const terrain::SurfaceMap* map = world.surfaces->surface_map(); map != nullptr)
    for (const terrain::SurfacePatch& patch : map->patches())
      view.add_ring(patch.outline_m, CutEdge::kPaint, found.back().edges);

  std::vector<std::size_t> first_edge{0};
  for (const Found& block : found) {
    first_edge.push_back(first_edge.back() + block.edges.size());
    below_sensor_.insert(below_sensor_.end(), block.below_sensor.begin(), block.below_sensor.end());
  }
  const TileFinder tile_of(headings_rad, tile);
  edges_.resize(first_edge.back());
  std::vector<EdgePlace> places(edges_.size());
  core::parallel_for(found.size(), [&](std::size_t block) {
    std::size_t at = first_edge[block];
    for (const CutEdge& edge : found[block].edges) {
      edges_[at] = edge;
      places[at++] = place_of(edge, tile_of, far_m);
    }
  });

  tile_begin_.assign(tile_of.tiles() + 1, 0);
  for (const EdgePlace& place : places)
    for (std::size_t t = place.first_tile; t <= place.last_tile; ++t) ++tile_begin_[t + 1];
  for (std::size_t t = 0; t < tile_of.tiles(); ++t) tile_begin_[t + 1] += tile_begin_[t];
  edge_of_tile_.resize(tile_begin_.back());
  std::vector<std::size_t> next(tile_begin_.begin(), tile_begin_.end() - 1);
  for (const std::uint32_t i : by_distance(places))
    for (std::size_t t = places[i].first_tile; t <= places[i].last_tile; ++t)
      edge_of_tile_[next[t]++] = i;
}

}  // namespace fanbeam::renderer
