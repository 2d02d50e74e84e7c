#include "renderer/casting/profile/slice_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fanbeam::renderer {
namespace {

constexpr double kBelowEverything = -1e300;

}  // namespace

SliceSweep::SliceSweep(const World& world, const glm::dvec3& sensor_m, const EdgeIndex& edges)
    : world_(world),
      ground_(world.surfaces->terrain()),
      map_(world.surfaces->surface_map()),
      sensor_m_(sensor_m),
      edges_(edges) {}

void SliceSweep::run(const Slice& slice, const EdgeIndex::Candidates& candidates, double far_m,
                     VisiblePieces& pieces, const Full& full) {
  slice_ = slice;
  pieces_ = &pieces;
  full_ = &full;
  horizon_ = kBelowEverything;
  active_ = edges_.below_sensor();
  roof_from_m_ = 0.0;
  find_top();
  cut_ground(*ground_, {sensor_m_.x, sensor_m_.y}, slice.along, far_m, sensor_m_.z, cut_);
  find_events(candidates, far_m);
  std::size_t next = 0;
  for (std::size_t i = 0; i < cut_.pieces; ++i) {
    double d0 = cut_.distance_m[i], z0 = cut_.height_m[i];
    const double d1 = cut_.distance_m[i + 1], z1 = cut_.height_m[i + 1];
    while (next < events_.size() && events_[next].distance_m < d1) {
      const double at_m = std::max(events_[next].distance_m, d0);
      const double z = z0 + (z1 - z0) * ((at_m - d0) / (d1 - d0));
      walk_ground(d0, z0, at_m, z, i);
      d0 = at_m;
      z0 = z;
      pass(events_[next++], z);
    }
    walk_ground(d0, z0, d1, z1, i);
  }
  if (roofed_ && cut_.pieces > 0) close_roof(cut_.distance_m[cut_.pieces]);
}

// Edges come roughly sorted: insertion puts the rest in order.
void SliceSweep::find_events(const EdgeIndex::Candidates& candidates, double far_m) {
  events_.clear();
  const glm::dvec2 u = slice_.along;
  for (const std::uint32_t index : candidates) {
    const CutEdge& edge = edges_.edges()[index];
    const bool from_left = edge.from_rad <= slice_.heading_rad;
    if (from_left == (edge.to_rad <= slice_.heading_rad)) continue;
    const glm::dvec2 step = edge.to_m - edge.from_m;
    const double distance_m = edge.cross_m2 / (u.x * step.y - u.y * step.x);
    if (!(distance_m > 0.0 && distance_m < far_m)) continue;
    std::size_t place = events_.size();
    events_.push_back({distance_m, index});
    for (; place > 0 && events_[place - 1].distance_m > distance_m; --place)
      events_[place] = events_[place - 1];
    events_[place] = {distance_m, index};
  }
}

void SliceSweep::pass(const Event& event, double ground_m) {
  const CutEdge& edge = edges_.edges()[event.edge];
  if (edge.prism == CutEdge::kPaint) return;  // it has cut the ground already
  // The building lies left of the edge: beyond it when the edge runs clockwise.
  if (edge.from_rad < edge.to_rad)
    enter(event, edge, ground_m);
  else
    leave(event.distance_m, edge.prism);
}

void SliceSweep::enter(const Event& event, const CutEdge& edge, double ground_m) {
  const double top_m = world_.solids.prisms[edge.prism].top_m - sensor_m_.z;
  const double below_m = roofed_ ? std::max(roof_m_, ground_m) : ground_m;
  active_.push_back(edge.prism);
  if (roofed_ && top_m <= roof_m_) return;
  if (roofed_) close_roof(event.distance_m);
  if (top_m > below_m) see_wall(event.distance_m, below_m, top_m, edge);
  roof_from_m_ = event.distance_m;
  find_top();
}

void SliceSweep::leave(double distance_m, std::uint32_t prism) {
  const auto at = std::find(active_.begin(), active_.end(), prism);
  if (at == active_.end()) return;
  active_.erase(at);
  close_roof(distance_m);
  find_top();
}

void SliceSweep::find_top() {
  roofed_ = !active_.empty();
  roof_m_ = kBelowEverything;
  for (const std::uint32_t prism : active_) {
    const terrain::Solid& solid = world_.solids.prisms[prism];
    if (solid.top_m - sensor_m_.z <= roof_m_) continue;
    roof_m_ = solid.top_m - sensor_m_.z;
    roof_material_ = solid.roof;
  }
}

// Ground under a roof is hidden, ground that pokes through is not.
void SliceSweep::walk_ground(double d0, double z0, double d1, double z1, std::size_t piece) {
  if (!(d1 > d0)) return;
  if (!roofed_) {
    see_ground(d0, z0, d1, z1, piece);
    return;
  }
  if (z0 <= roof_m_ && z1 <= roof_m_) return;
  if (z0 >= roof_m_ && z1 >= roof_m_) {
    close_roof(d0);
    see_ground(d0, z0, d1, z1, piece);
    roof_from_m_ = d1;
    return;
  }
  const double at_m = d0 + (d1 - d0) * ((roof_m_ - z0) / (z1 - z0));
  if (z0 < roof_m_) {
    close_roof(at_m);
    see_ground(at_m, roof_m_, d1, z1, piece);
    roof_from_m_ = d1;
  } else {
    close_roof(d0);
    see_ground(d0, z0, at_m, roof_m_, piece);
    roof_from_m_ = at_m;
  }
}

// Moves the near end of a piece to where it comes out of the horizon; false when it does not.
bool SliceSweep::visible(double& d0, double& z0, double d1, double z1) {
  if (z1 <= horizon_ * d1) return false;
  if (z0 < horizon_ * d0) {
    const double under0 = horizon_ * d0 - z0, over1 = z1 - horizon_ * d1;
    const double share = under0 / (under0 + over1);
    d0 += share * (d1 - d0);
    z0 += share * (z1 - z0);
  }
  horizon_ = z1 / d1;
  return d1 > d0;  // rounding may leave nothing
}

int SliceSweep::next_piece() {
  if (pieces_->full()) (*full_)(*pieces_);
  return pieces_->count++;
}

void SliceSweep::see_ground(double d0, double z0, double d1, double z1, std::size_t piece) {
  if (!visible(d0, z0, d1, z1)) return;
  const GroundCut::Cell& cell = cut_.cells[piece];
  const double* sw = &ground_->height_m[ground_->post(cell.column, cell.row)];
  const std::ptrdiff_t stride = ground_->columns;
  const double per_m = 1.0 / ground_->spacing_m;
  const double ne = sw[stride + 1];
  const double gx = (cell.upper ? ne - sw[stride] : sw[1] - sw[0]) * per_m;
  const double gy = (cell.upper ? sw[stride] - sw[0] : ne - sw[1]) * per_m;
  const double slope = gx * slice_.along.x + gy * slice_.along.y;
  const int i = next_piece();
  pieces_->near_distance_m[i] = d0;
  pieces_->near_height_m[i] = z0;
  pieces_->far_distance_m[i] = d1;
  pieces_->far_height_m[i] = z1;
  // The facet's plane passes this far below the sensor.
  const double below_m = slope * d1 - z1;
  pieces_->cross_m2[i] = below_m * (d1 - d0);
  pieces_->facet_m[i] = below_m;
  pieces_->facet_d2[i] = 1.0 + gx * gx + gy * gy;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  const double middle_m = (d0 + d1) / 2;
  pieces_->material[i] = map_->material_in_cell(cell.column, cell.row,
                                                sensor_m_.x + slice_.along.x * middle_m,
                                                sensor_m_.y + slice_.along.y * middle_m);
}

void SliceSweep::close_roof(double distance_m) {
  double d0 = roof_from_m_, z0 = roof_m_;
  roof_from_m_ = distance_m;
  if (!(distance_m > d0) || !visible(d0, z0, distance_m, roof_m_)) return;
  const int i = next_piece();
  pieces_->near_distance_m[i] = d0;
  pieces_->near_height_m[i] = roof_m_;
  pieces_->far_distance_m[i] = distance_m;
  pieces_->far_height_m[i] = roof_m_;
  pieces_->cross_m2[i] = -roof_m_ * (distance_m - d0);
  pieces_->facet_m[i] = -roof_m_;
  pieces_->facet_d2[i] = 1.0;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  pieces_->material[i] = roof_material_;
}

void SliceSweep::see_wall(double distance_m, double low_m, double top_m, const CutEdge& edge) {
  const double from_m = std::max(low_m, horizon_ * distance_m);
  if (!(top_m > from_m)) return;
  horizon_ = top_m / distance_m;
  const glm::dvec2 step = edge.to_m - edge.from_m;
  // The wall stands at cross / (along x step) under every heading; the wedge's borders are clipped
  // to the wall's corners.
  const double across = slice_.along.x * step.y - slice_.along.y * step.x;
  const double beside = glm::dot(slice_.along, step);
  const double range_per_distance =
      distance_m / std::sqrt(distance_m * distance_m + top_m * top_m);
  const auto moved_m = [&](double turn_rad) {
    const double there_m =
        edge.cross_m2 / (across * std::cos(turn_rad) + beside * std::sin(turn_rad));
    return (there_m - distance_m) * range_per_distance;
  };
  const double half_rad = slice_.width_rad / 2;
  const double left_m = moved_m(std::max(edge.from_rad - slice_.heading_rad, -half_rad));
  const double right_m = moved_m(std::min(edge.to_rad - slice_.heading_rad, half_rad));
  const int i = next_piece();
  pieces_->near_distance_m[i] = pieces_->far_distance_m[i] = distance_m;
  pieces_->near_height_m[i] = from_m;
  pieces_->far_height_m[i] = top_m;
  pieces_->cross_m2[i] = distance_m * (top_m - from_m);
  pieces_->facet_d2[i] = 1.0;
  pieces_->facet_m[i] = std::abs(edge.cross_m2) / glm::length(step);
  pieces_->nearer_m[i] = std::min({left_m, right_m, 0.0});
  pieces_->farther_m[i] = std::max({left_m, right_m, 0.0});
  pieces_->material[i] = world_.solids.prisms[edge.prism].wall;
}

}  // namespace fanbeam::renderer
