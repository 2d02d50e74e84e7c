#include "renderer/casting/profile/edge_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/constants.h"
#include "core/parallel.h"

namespace fanbeam::renderer {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// One view from above: what of a ring stands between two headings.
class PlanView {
 public:
  PlanView(const glm::dvec3& sensor_m, const glm::dvec2& forward, double left_rad, double right_rad,
           double far_m)
      : sensor_m_(sensor_m),
        sensor_height_m_(sensor_m.z),
        forward_(forward),
        right_(forward.y, -forward.x),
        left_rad_(left_rad),
        right_rad_(right_rad),
        left_ray_(forward * std::cos(left_rad) + right_ * std::sin(left_rad)),
        right_ray_(forward * std::cos(right_rad) + right_ * std::sin(right_rad)),
        far_m_(far_m),
        all_round_(right_rad - left_rad >= 2.0 * core::kPi) {}

  // Appends the ring's edges in view. True when the sensor stands inside the ring.
  bool add_ring(const PlanRing& ring, std::vector<CutEdge>& edges) const {
    const glm::dvec2 low = ring.low_m - sensor_m_, high = ring.high_m - sensor_m_;
    const bool around = low.x <= 0.0 && low.y <= 0.0 && high.x >= 0.0 && high.y >= 0.0;
    const glm::dvec2 nearest = glm::clamp(glm::dvec2(0.0), low, high);
    if (glm::dot(nearest, nearest) > far_m_ * far_m_) return false;
    if (!around && behind(low, high)) return false;
    const double highest_tangent = highest(ring.top_m - sensor_height_m_, low, high, nearest);
    double turned_rad = 0.0;
    glm::dvec2 from = ring.corners_m->back() - sensor_m_;
    double from_rad = heading_rad(from);
    for (const glm::dvec2& corner : *ring.corners_m) {
      const glm::dvec2 to = corner - sensor_m_;
      const double to_rad = heading_rad(to);
      if (around) turned_rad += std::remainder(to_rad - from_rad, 2.0 * core::kPi);
      // Edges that pass behind the sensor cross the jump of the heading: far from any slice, or, with
      // slices all round, on both sides of it.
      const bool jumps = std::abs(to_rad - from_rad) >= core::kPi;
      const bool seen = !jumps && std::max(from_rad, to_rad) >= left_rad_ &&
                        std::min(from_rad, to_rad) <= right_rad_;
      const double round_rad = from_rad > 0.0 ? 2.0 * core::kPi : -2.0 * core::kPi;
      const auto add = [&](double begin_rad, double end_rad) {
        edges.push_back(
            {from, to, begin_rad, end_rad, cross(from, to), highest_tangent, ring.prism});
      };
      if (seen) {
        add(from_rad, to_rad);
      } else if (jumps && all_round_) {
        add(from_rad, to_rad + round_rad);
        add(from_rad - round_rad, to_rad);
      }
      from = to;
      from_rad = to_rad;
    }
    return std::abs(turned_rad) > core::kPi;
  }

 private:
  double heading_rad(const glm::dvec2& relative_m) const {
    return std::atan2(glm::dot(relative_m, right_), glm::dot(relative_m, forward_));
  }
  static double highest(double top_m, const glm::dvec2& low, const glm::dvec2& high,
                        const glm::dvec2& nearest) {
    const glm::dvec2 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double near_m = glm::length(nearest);
    if (top_m < 0.0) return top_m / glm::length(farthest);
    return near_m > 0.0 ? top_m / near_m : std::numeric_limits<double>::infinity();
  }
  // The whole box lies outside the sector; only sure for sectors narrower than a half-turn.
  bool behind(const glm::dvec2& low, const glm::dvec2& high) const {
    const auto all_left_of = [&](const glm::dvec2& ray, double sign) {
      for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 at((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
        if (sign * cross(ray, at) <= 0.0) return false;
      }
      return true;
    };
    const bool narrow = right_rad_ - left_rad_ < core::kPi;
    return narrow && (all_left_of(left_ray_, 1.0) || all_left_of(right_ray_, -1.0));
  }

  glm::dvec2 sensor_m_;
  double sensor_height_m_;
  glm::dvec2 forward_, right_;
  double left_rad_, right_rad_;
  glm::dvec2 left_ray_, right_ray_;
  double far_m_;
  bool all_round_;
};

// One of the rings of what `outline_m` goes around.
PlanRing plan_ring(const std::vector<glm::dvec2>& outline_m, double top_m,
                   const std::vector<glm::dvec2>& corners_m, std::uint32_t prism) {
  PlanRing ring{outline_m.front(), outline_m.front(), top_m, &corners_m, prism};
  for (const glm::dvec2& corner : outline_m) {
    ring.low_m = glm::min(ring.low_m, corner);
    ring.high_m = glm::max(ring.high_m, corner);
  }
  return ring;
}

// In which tile of slices a heading lies: that of the first wedge that ends right of it.
class TileFinder {
 public:
  TileFinder(const std::vector<Slice>& slices, std::size_t tile)
      : slices_(slices),
        tile_(tile),
        last_tile_((slices.size() - 1) / tile),
        per_rad_(slices.size() > 1 ? static_cast<double>(slices.size() - 1) /
                                         (slices.back().heading_rad - slices.front().heading_rad)
                                   : 0.0) {}

  std::size_t tiles() const { return last_tile_ + 1; }
  std::uint32_t operator()(double heading_rad) const {
    // Headings are nearly even: a guess is right or next to it.
    const double guess = (heading_rad - right_rad(0)) * per_rad_;
    const auto most = static_cast<double>(slices_.size());
    auto slice = static_cast<std::size_t>(std::clamp(guess, 0.0, most));
    while (slice > 0 && right_rad(slice - 1) >= heading_rad) --slice;
    while (slice < slices_.size() && right_rad(slice) < heading_rad) ++slice;
    return static_cast<std::uint32_t>(std::min(slice / tile_, last_tile_));
  }

 private:
  double right_rad(std::size_t slice) const {
    return slices_[slice].heading_rad + slices_[slice].width_rad / 2;
  }

  const std::vector<Slice>& slices_;
  std::size_t tile_, last_tile_;
  double per_rad_;
};

// Where an edge goes: the tiles that it spans, and its middle's distance in steps.
struct EdgePlace {
  const CutEdge* edge;
  std::uint32_t first_tile, last_tile;
  std::uint32_t distance_step;
};
constexpr std::size_t kDistanceSteps = 512;

EdgePlace place_of(const CutEdge& edge, const TileFinder& tile_of, double far_m) {
  const double share = glm::length(edge.from_m + edge.to_m) / 2 / far_m;
  return {&edge, tile_of(std::min(edge.from_rad, edge.to_rad)),
          tile_of(std::max(edge.from_rad, edge.to_rad)),
          static_cast<std::uint32_t>(std::min(share * kDistanceSteps, kDistanceSteps - 1.0))};
}

// What a block of rings has in view.
struct Found {
  std::vector<EdgePlace> places;
  std::vector<std::uint32_t> around;  // prisms, once for each ring around the sensor
};

// By their distance steps: a counting sort.
std::vector<EdgePlace> by_distance(const std::vector<Found>& found) {
  std::vector<std::size_t> begin(kDistanceSteps + 1, 0);
  for (const Found& block : found)
    for (const EdgePlace& place : block.places) ++begin[place.distance_step + 1U];
  for (std::size_t b = 0; b < kDistanceSteps; ++b) begin[b + 1] += begin[b];
  std::vector<EdgePlace> sorted(begin.back());
  for (const Found& block : found)
    for (const EdgePlace& place : block.places) sorted[begin[place.distance_step]++] = place;
  return sorted;
}

// A courtyard around the sensor takes its building away again.
std::vector<std::uint32_t> prisms_around(const std::vector<Found>& found) {
  std::vector<std::uint32_t> prisms;
  for (const Found& block : found)
    for (const std::uint32_t prism : block.around) {
      if (prism == CutEdge::kPaint) continue;
      if (!prisms.empty() && prisms.back() == prism)
        prisms.pop_back();
      else
        prisms.push_back(prism);
    }
  return prisms;
}

}  // namespace

std::vector<PlanRing> plan_rings(const World& world) {
  std::vector<PlanRing> rings;
  for (std::size_t i = 0; i < world.solids().prisms.size(); ++i) {
    const terrain::Solid& solid = world.solids().prisms[i];
    for (const auto& ring_m : solid.rings_m)
      rings.push_back(
          plan_ring(solid.rings_m.front(), solid.top_m, ring_m, static_cast<std::uint32_t>(i)));
  }
  if (const terrain::SurfaceMap* map = world.surfaces().surface_map(); map != nullptr)
    for (const terrain::SurfacePatch& patch : map->patches())
      rings.push_back(plan_ring(patch.outline_m, 0.0, patch.outline_m, CutEdge::kPaint));
  return rings;
}

EdgeIndex::EdgeIndex(const std::vector<PlanRing>& rings, double far_m, const glm::dvec3& sensor_m,
                     const glm::dvec2& forward, const std::vector<Slice>& slices,
                     std::size_t tile) {
  const PlanView view(sensor_m, forward, slices.front().heading_rad - slices.front().width_rad,
                      slices.back().heading_rad + slices.back().width_rad, far_m);
  const TileFinder tile_of(slices, tile);
  constexpr std::size_t kAtOnce = 256;
  edges_.resize((rings.size() + kAtOnce - 1) / kAtOnce);
  std::vector<Found> found(edges_.size());
  core::parallel_for(found.size(), [&](std::size_t block) {
    std::vector<CutEdge>& edges = edges_[block];
    const std::size_t end = std::min((block + 1) * kAtOnce, rings.size());
    for (std::size_t i = block * kAtOnce; i < end; ++i)
      if (view.add_ring(rings[i], edges)) found[block].around.push_back(rings[i].prism);
    found[block].places.reserve(edges.size());
    for (const CutEdge& edge : edges) found[block].places.push_back(place_of(edge, tile_of, far_m));
  });
  below_sensor_ = prisms_around(found);

  const std::vector<EdgePlace> places = by_distance(found);
  tile_begin_.assign(tile_of.tiles() + 1, 0);
  for (const EdgePlace& place : places)
    for (std::size_t t = place.first_tile; t <= place.last_tile; ++t) ++tile_begin_[t + 1];
  for (std::size_t t = 0; t < tile_of.tiles(); ++t) tile_begin_[t + 1] += tile_begin_[t];
  edge_of_tile_.resize(tile_begin_.back());
  std::vector<std::size_t> next(tile_begin_.begin(), tile_begin_.end() - 1);
  for (const EdgePlace& place : places)
    for (std::size_t t = place.first_tile; t <= place.last_tile; ++t)
      edge_of_tile_[next[t]++] = place.edge;
}

}  // namespace fanbeam::renderer
