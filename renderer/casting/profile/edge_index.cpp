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
    for (const glm::dvec2& corner : ring_m) {
      const glm::dvec2 to = corner - sensor_m_;
      const double to_rad = heading_rad(to);
      turned_rad += std::remainder(to_rad - from_rad, 2.0 * core::kPi);
      // Edges that pass behind the sensor cross the jump of the heading, far from any slice.
      if (std::abs(to_rad - from_rad) < core::kPi && std::max(from_rad, to_rad) >= left_rad_ &&
          std::min(from_rad, to_rad) <= right_rad_)
        edges.push_back({from, to, from_rad, to_rad, cross(from, to), prism});
      from = to;
      from_rad = to_rad;
    }
    return std::abs(turned_rad) > core::kPi;
  }

 private:
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

// Numbers of the edges in the order of their middles' distance, roughly: a counting sort.
std::vector<std::uint32_t> by_distance(const std::vector<CutEdge>& edges, double far_m) {
  constexpr std::size_t kBuckets = 512;
  std::vector<std::size_t> begin(kBuckets + 1, 0);
  std::vector<std::uint16_t> bucket(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double share = glm::length(edges[i].from_m + edges[i].to_m) / 2 / far_m;
    bucket[i] = static_cast<std::uint16_t>(std::min(share * kBuckets, kBuckets - 1.0));
    ++begin[bucket[i] + 1U];
  }
  for (std::size_t b = 0; b < kBuckets; ++b) begin[b + 1] += begin[b];
  std::vector<std::uint32_t> order(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    order[begin[bucket[i]]++] = static_cast<std::uint32_t>(i);
  return order;
}

}  // namespace

EdgeIndex::EdgeIndex(const World& world, const glm::dvec2& sensor_m, const glm::dvec2& forward,
                     const std::vector<double>& headings_rad, std::size_t tile) {
  const double far_m = world.sensor.range.maximum_m();
  const PlanView view(sensor_m, forward, headings_rad.front(), headings_rad.back(), far_m);
  const std::vector<terrain::Solid>& prisms = world.solids.prisms;
  struct Found {
    std::vector<CutEdge> edges;
    std::vector<std::uint32_t> below_sensor;
  };
  constexpr std::size_t kAtOnce = 1024;
  std::vector<Found> found((prisms.size() + kAtOnce - 1) / kAtOnce);
  core::parallel_for(found.size(), [&](std::size_t block) {
    for (std::size_t i = block * kAtOnce; i < std::min((block + 1) * kAtOnce, prisms.size()); ++i) {
      const auto prism = static_cast<std::uint32_t>(i);
      bool inside = false;
      for (const auto& ring : prisms[i].rings_m)
        if (view.add_ring(ring, prism, found[block].edges)) inside = !inside;
      if (inside) found[block].below_sensor.push_back(prism);
    }
  });
  for (const Found& block : found) {
    edges_.insert(edges_.end(), block.edges.begin(), block.edges.end());
    below_sensor_.insert(below_sensor_.end(), block.below_sensor.begin(), block.below_sensor.end());
  }
  if (const terrain::SurfaceMap* map = world.surfaces->surface_map(); map != nullptr)
    for (const terrain::SurfacePatch& patch : map->patches())
      view.add_ring(patch.outline_m, CutEdge::kPaint, edges_);

  const std::size_t tiles = (headings_rad.size() + tile - 1) / tile;
  const auto tile_of = [&](double heading_rad) {
    const auto slice = std::lower_bound(headings_rad.begin(), headings_rad.end(), heading_rad) -
                       headings_rad.begin();
    return std::min(static_cast<std::size_t>(slice) / tile, tiles - 1);
  };
  std::vector<std::uint32_t> first(edges_.size()), last(edges_.size());
  tile_begin_.assign(tiles + 1, 0);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const CutEdge& edge = edges_[i];
    first[i] = static_cast<std::uint32_t>(tile_of(std::min(edge.from_rad, edge.to_rad)));
    last[i] = static_cast<std::uint32_t>(tile_of(std::max(edge.from_rad, edge.to_rad)));
    for (std::size_t t = first[i]; t <= last[i]; ++t) ++tile_begin_[t + 1];
  }
  for (std::size_t t = 0; t < tiles; ++t) tile_begin_[t + 1] += tile_begin_[t];
  edge_of_tile_.resize(tile_begin_.back());
  std::vector<std::size_t> next(tile_begin_.begin(), tile_begin_.end() - 1);
  for (const std::uint32_t i : by_distance(edges_, far_m))
    for (std::size_t t = first[i]; t <= last[i]; ++t) edge_of_tile_[next[t]++] = i;
}

}  // namespace fanbeam::renderer
