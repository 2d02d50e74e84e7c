#include "renderer/casting/profile/slice_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/casting/caster.h"

namespace fanbeam::renderer {
namespace {

constexpr double kBelowEverything = -1e300;

}  // namespace

SliceSweep::SliceSweep(const World& world, const glm::dvec3& sensor_m, const EdgeIndex& edges,
                       double darkest_tangent, bool fronts, SweepScratch& scratch)
    : world_(world),
      ground_(world.surfaces->terrain()),
      map_(world.surfaces->surface_map()),
      sensor_m_(sensor_m),
      edges_(edges),
      darkest_tangent_(darkest_tangent),
      fronts_(fronts),
      cut_(scratch.cut),
      events_(scratch.events),
      front_(scratch.front) {}

void SliceSweep::run(const Slice& slice, const EdgeIndex::Candidates& candidates, double far_m,
                     VisiblePieces& pieces, const Full& full, const Sights& sights) {
  wedge_ = Wedge(slice);
  sights_ = sights;
  pieces_ = &pieces;
  full_ = &full;
  horizon_tangent_ = kBelowEverything;
  active_ = edges_.below_sensor();
  left_already_.clear();
  roof_from_m_ = 0.0;
  find_top();
  cut_ground(*ground_, {sensor_m_.x, sensor_m_.y}, slice.along, far_m, sensor_m_.z, cut_);
  // Seen from outside, the grid's rim hides what lies under it.
  if (cut_.pieces > 0 && cut_.distance_m[0] > 0.0)
    horizon_tangent_ = cut_.height_m[0] / cut_.distance_m[0];
  find_events(candidates, far_m);
  std::size_t next = 0;
  for (std::size_t i = 0; i < cut_.pieces; ++i) {
    ProfilePoint near{cut_.distance_m[i], cut_.height_m[i]};
    const ProfilePoint far{cut_.distance_m[i + 1], cut_.height_m[i + 1]};
    while (next < events_.size() && events_[next].distance_m < far.distance_m) {
      const double at_m = std::max(events_[next].distance_m, near.distance_m);
      const double share = (at_m - near.distance_m) / (far.distance_m - near.distance_m);
      const ProfilePoint at{at_m, near.height_m + (far.height_m - near.height_m) * share};
      walk_ground(near, at, i);
      near = at;
      pass(events_[next++], at.height_m);
    }
    walk_ground(near, far, i);
  }
  if (roofed_ && cut_.pieces > 0) close_roof(cut_.distance_m[cut_.pieces]);
}

// Edges come roughly sorted: insertion puts the rest in order.
void SliceSweep::find_events(const EdgeIndex::Candidates& candidates, double far_m) {
  events_.clear();
  const glm::dvec2 u = wedge_.slice.along;
  for (const std::uint32_t index : candidates) {
    const CutEdge& edge = edges_.edges()[index];
    const bool from_left = edge.from_rad <= wedge_.slice.heading_rad;
    if (from_left == (edge.to_rad <= wedge_.slice.heading_rad)) continue;
    const double distance_m = crossing_m(edge, u);
    if (distance_m < far_m) add_event(distance_m, index);
  }
  auto number = static_cast<std::uint32_t>(edges_.edges().size());
  for (const SightPoint* point = sights_.first; point != sights_.last; ++point, ++number) {
    // Straight below, and before the rim of the ground, other means must tell.
    if (cut_.pieces == 0 || point->distance_m <= cut_.distance_m[0]) continue;
    const double range_m = std::hypot(point->distance_m, point->height_m);
    const double share = std::max(1.0 - kSightClearance_m / range_m, 0.0);
    add_event(point->distance_m * share, number);
  }
}

void SliceSweep::add_event(double distance_m, std::uint32_t edge) {
  std::size_t place = events_.size();
  events_.push_back({distance_m, edge});
  for (; place > 0 && events_[place - 1].distance_m > distance_m; --place)
    events_[place] = events_[place - 1];
  events_[place] = {distance_m, edge};
}

void SliceSweep::test(const SightPoint& point, double at_m) {
  const double tangent = point.height_m / point.distance_m;
  const bool in_a_building = roofed_ && tangent * at_m < roof_m_;
  sights_.clear[point.line] = tangent >= horizon_tangent_ && !in_a_building ? 1 : 0;
}

void SliceSweep::pass(const SliceEvent& event, double ground_m) {
  if (event.edge >= edges_.edges().size()) {
    test(sights_.first[event.edge - edges_.edges().size()], event.distance_m);
    return;
  }
  const CutEdge& edge = edges_.edges()[event.edge];
  if (edge.prism == CutEdge::kPaint) return;  // it has cut the ground already
  // The building lies left of the edge: beyond it when the edge runs clockwise.
  if (edge.from_rad < edge.to_rad)
    enter(event, edge, ground_m);
  else
    leave(event.distance_m, edge.prism);
}

void SliceSweep::enter(const SliceEvent& event, const CutEdge& edge, double ground_m) {
  const auto left = std::find(left_already_.begin(), left_already_.end(), edge.prism);
  if (left != left_already_.end()) {
    left_already_.erase(left);
    return;
  }
  const double top_m = world_.solids.prisms[edge.prism].top_m - sensor_m_.z;
  const double below_m = roofed_ ? std::max(roof_m_, ground_m) : ground_m;
  active_.push_back(edge.prism);
  if (roofed_ && top_m <= roof_m_) return;
  if (roofed_) close_roof(event.distance_m);
  if (top_m > below_m) see_wall(event, below_m, top_m);
  roof_from_m_ = event.distance_m;
  find_top();
}

void SliceSweep::leave(double distance_m, std::uint32_t prism) {
  const auto at = std::find(active_.begin(), active_.end(), prism);
  if (at == active_.end()) {
    // Rounding at a corner may put the way out before the way in.
    left_already_.push_back(prism);
    return;
  }
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
void SliceSweep::walk_ground(const ProfilePoint& near, const ProfilePoint& far, std::size_t piece) {
  if (!(far.distance_m > near.distance_m)) return;
  if (!roofed_) {
    see_ground(near, far, piece);
    return;
  }
  if (near.height_m <= roof_m_ && far.height_m <= roof_m_) return;
  if (near.height_m >= roof_m_ && far.height_m >= roof_m_) {
    close_roof(near.distance_m);
    see_ground(near, far, piece);
    roof_from_m_ = far.distance_m;
    return;
  }
  const double share = (roof_m_ - near.height_m) / (far.height_m - near.height_m);
  const ProfilePoint at{near.distance_m + (far.distance_m - near.distance_m) * share, roof_m_};
  if (near.height_m < roof_m_) {
    close_roof(at.distance_m);
    see_ground(at, far, piece);
    roof_from_m_ = far.distance_m;
  } else {
    close_roof(near.distance_m);
    see_ground(near, at, piece);
    roof_from_m_ = at.distance_m;
  }
}

// Moves the near end of a piece to where it comes out of the horizon; false when it does not.
bool SliceSweep::visible(ProfilePoint& near, const ProfilePoint& far) {
  const double over_far_m = far.height_m - horizon_tangent_ * far.distance_m;
  if (over_far_m <= 0.0) return false;
  const double under_near_m = horizon_tangent_ * near.distance_m - near.height_m;
  if (under_near_m > 0.0) {
    const double share = under_near_m / (under_near_m + over_far_m);
    near.distance_m += share * (far.distance_m - near.distance_m);
    near.height_m += share * (far.height_m - near.height_m);
  }
  horizon_tangent_ = far.height_m / far.distance_m;
  return far.distance_m > near.distance_m;  // rounding may leave nothing
}

int SliceSweep::next_piece() {
  if (pieces_->full()) (*full_)(*pieces_);
  return pieces_->count++;
}

void SliceSweep::see_ground(ProfilePoint near, const ProfilePoint& far, std::size_t piece) {
  if (!visible(near, far) || far.height_m < darkest_tangent_ * far.distance_m) return;
  const GroundCut::Cell& cell = cut_.cells[piece];
  const double* sw = &ground_->height_m[ground_->post(cell.column, cell.row)];
  const std::ptrdiff_t stride = ground_->columns;
  const double per_m = 1.0 / ground_->spacing_m;
  const double ne = sw[stride + 1];
  const double gx = (cell.upper ? ne - sw[stride] : sw[1] - sw[0]) * per_m;
  const double gy = (cell.upper ? sw[stride] - sw[0] : ne - sw[1]) * per_m;
  const double slope = gx * wedge_.slice.along.x + gy * wedge_.slice.along.y;
  // The facet's plane passes this far below the sensor.
  const double below_m = slope * far.distance_m - far.height_m;
  const double middle_m = (near.distance_m + far.distance_m) / 2;
  const std::int32_t material =
      map_->material_in_cell(cell.column, cell.row, sensor_m_.x + wedge_.slice.along.x * middle_m,
                             sensor_m_.y + wedge_.slice.along.y * middle_m);
  const int i = next_piece();
  pieces_->near_distance_m[i] = near.distance_m;
  pieces_->near_height_m[i] = near.height_m;
  pieces_->far_distance_m[i] = far.distance_m;
  pieces_->far_height_m[i] = far.height_m;
  pieces_->cross_m2[i] = below_m * (far.distance_m - near.distance_m);
  pieces_->facet_m[i] = below_m;
  pieces_->facet_d2[i] = 1.0 + gx * gx + gy * gy;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  pieces_->share[i] = 1.0;
  pieces_->material[i] = material;
}

void SliceSweep::close_roof(double distance_m) {
  ProfilePoint near{roof_from_m_, roof_m_};
  roof_from_m_ = distance_m;
  if (!(distance_m > near.distance_m) || !visible(near, {distance_m, roof_m_})) return;
  const int i = next_piece();
  pieces_->near_distance_m[i] = near.distance_m;
  pieces_->near_height_m[i] = roof_m_;
  pieces_->far_distance_m[i] = distance_m;
  pieces_->far_height_m[i] = roof_m_;
  pieces_->cross_m2[i] = -roof_m_ * (distance_m - near.distance_m);
  pieces_->facet_m[i] = -roof_m_;
  pieces_->facet_d2[i] = 1.0;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  pieces_->share[i] = 1.0;
  pieces_->material[i] = roof_material_;
}

void SliceSweep::see_wall(const SliceEvent& event, double low_m, double top_m) {
  const double horizon_tangent = horizon_tangent_;
  if (!(top_m > std::max(low_m, horizon_tangent * event.distance_m))) return;
  horizon_tangent_ = top_m / event.distance_m;
  const CutEdge& edge = edges_.edges()[event.edge];
  const std::int32_t material = world_.solids.prisms[edge.prism].wall;
  if (fronts_ && !roofed_)
    front_of(edges_.edges(), event.edge, wedge_, front_);
  else
    wall_in_wedge(edge, wedge_, front_);
  for (int i = 0; i < front_.count; ++i) {
    const WallPart& part = front_.parts[static_cast<std::size_t>(i)];
    const double from_m = std::max(low_m, horizon_tangent * part.distance_m);
    if (top_m > from_m) add_wall(part, from_m, top_m, material);
  }
}

void SliceSweep::add_wall(const WallPart& part, double from_m, double top_m,
                          std::int32_t material) {
  const double distance_m = part.distance_m;
  const double range_per_distance = distance_m / std::sqrt(distance_m * distance_m + top_m * top_m);
  const int parts = parts_of(distance_m * (top_m - from_m),
                             distance_m * distance_m + std::min(from_m * from_m, top_m * top_m));
  const double part_m = (top_m - from_m) / parts;
  for (int k = 0; k < parts; ++k) {
    const int i = next_piece();
    pieces_->near_distance_m[i] = pieces_->far_distance_m[i] = distance_m;
    pieces_->near_height_m[i] = from_m + part_m * k;
    pieces_->far_height_m[i] = k + 1 == parts ? top_m : from_m + part_m * (k + 1);
    pieces_->cross_m2[i] = distance_m * part_m;
    pieces_->facet_d2[i] = 1.0;
    pieces_->facet_m[i] = part.facet_m;
    pieces_->nearer_m[i] = part.nearer_m * range_per_distance;
    pieces_->farther_m[i] = part.farther_m * range_per_distance;
    pieces_->share[i] = part.share;
    pieces_->material[i] = material;
  }
}

}  // namespace fanbeam::renderer
