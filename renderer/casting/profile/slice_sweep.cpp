#include "renderer/casting/profile/slice_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/casting/caster.h"

namespace fanbeam::renderer {
namespace {

// Moves the near end of a piece to where it comes out of the horizon, and the horizon with it; false
// when it does not.
bool visible(WedgeStrip& strip, ProfilePoint& near, const ProfilePoint& far) {
  const double over_far_m = far.height_m - strip.horizon_tangent * far.distance_m;
  if (over_far_m <= 0.0) return false;
  const double under_near_m = strip.horizon_tangent * near.distance_m - near.height_m;
  if (under_near_m > 0.0) {
    const double share = under_near_m / (under_near_m + over_far_m);
    near.distance_m += share * (far.distance_m - near.distance_m);
    near.height_m += share * (far.height_m - near.height_m);
  }
  strip.horizon_tangent = far.height_m / far.distance_m;
  return far.distance_m > near.distance_m;  // rounding may leave nothing
}

}  // namespace

SliceSweep::SliceSweep(const World& world, const glm::dvec3& sensor_m, const EdgeIndex& edges,
                       double darkest_tangent, SweepScratch& scratch)
    : world_(world),
      ground_(world.surfaces().terrain()),
      map_(world.surfaces().surface_map()),
      sensor_m_(sensor_m),
      edges_(edges),
      darkest_tangent_(darkest_tangent),
      cut_(scratch.cut),
      events_(scratch.events),
      parts_(scratch.parts),
      strips_(scratch.strips) {}

void SliceSweep::run(const Slice& slice, const EdgeIndex::Candidates& candidates, double far_m,
                     VisiblePieces& pieces, const Full& full, const Sights& sights) {
  wedge_ = Wedge(slice);
  sights_ = sights;
  pieces_ = &pieces;
  full_ = &full;
  strips_.reset(wedge_.range(), edges_.below_sensor());
  WedgeStrip& whole = *strips_.all().begin();
  strips_.find_roof(whole, world_.solids().prisms, sensor_m_.z);
  cut_ground(*ground_, {sensor_m_.x, sensor_m_.y}, slice.along, far_m, sensor_m_.z, cut_);
  // Seen from outside, the grid's rim hides what lies under it.
  if (cut_.pieces > 0 && cut_.distance_m[0] > 0.0)
    whole.horizon_tangent = cut_.height_m[0] / cut_.distance_m[0];
  find_events(candidates, far_m);
  std::size_t next = 0;
  for (std::size_t i = 0; i < cut_.pieces; ++i) {
    const ProfilePoint near{cut_.distance_m[i], cut_.height_m[i]};
    const ProfilePoint far{cut_.distance_m[i + 1], cut_.height_m[i + 1]};
    changed_ = false;
    if (next < events_.size() && events_[next].distance_m < far.distance_m) {
      for (WedgeStrip& strip : strips_.all()) strip.walked = near;
      for (; next < events_.size() && events_[next].distance_m < far.distance_m; ++next) {
        const double at_m = std::max(events_[next].distance_m, near.distance_m);
        const double share = (at_m - near.distance_m) / (far.distance_m - near.distance_m);
        pass(events_[next], {at_m, near.height_m + (far.height_m - near.height_m) * share}, i);
      }
      for (WedgeStrip& strip : strips_.all()) walk_ground(strip, strip.walked, far, i);
    } else {
      for (WedgeStrip& strip : strips_.all()) walk_ground(strip, near, far, i);
    }
    if (changed_ && !strips_.one()) strips_.join();
  }
  for (WedgeStrip& strip : strips_.all())
    if (strip.roofed && cut_.pieces > 0) close_roof(strip, cut_.distance_m[cut_.pieces]);
}

// Edges come roughly sorted: insertion puts the rest in order.
void SliceSweep::find_events(const EdgeIndex::Candidates& candidates, double far_m) {
  events_.clear();
  parts_.clear();
  const Slice& slice = wedge_.slice();
  for (const CutEdge* const edge : candidates) {
    HeadingRange part = wedge_.clip(*edge);
    if (!(part.right_rad > part.left_rad)) continue;
    if (edge->prism == CutEdge::kPaint) {
      if ((edge->from_rad <= slice.heading_rad) == (edge->to_rad <= slice.heading_rad)) continue;
      part = wedge_.range();
    }
    const double distance_m = wedge_.distance_m(*edge, part);
    if (!(distance_m < far_m)) continue;
    add_event({distance_m, edge, static_cast<std::uint32_t>(parts_.size())});
    parts_.push_back(part);
  }
  std::uint32_t number = 0;
  for (const SightPoint* point = sights_.first; point != sights_.last; ++point, ++number) {
    // Straight below, and before the rim of the ground, other means must tell.
    if (cut_.pieces == 0 || point->distance_m <= cut_.distance_m[0]) continue;
    const double range_m = std::hypot(point->distance_m, point->height_m);
    const double share = std::max(1.0 - kSightClearance_m / range_m, 0.0);
    add_event({point->distance_m * share, nullptr, number});
  }
}

void SliceSweep::add_event(const SliceEvent& event) {
  std::size_t place = events_.size();
  events_.push_back(event);
  for (; place > 0 && events_[place - 1].distance_m > event.distance_m; --place)
    events_[place] = events_[place - 1];
  events_[place] = event;
}

// `at` is the ground where it happens.
void SliceSweep::pass(const SliceEvent& event, const ProfilePoint& at, std::size_t piece) {
  if (event.edge == nullptr) {
    test(sights_.first[event.number], at, piece);
    return;
  }
  const CutEdge& edge = *event.edge;
  if (edge.prism == CutEdge::kPaint) {
    for (WedgeStrip& strip : strips_.all()) walk_to(strip, at, piece);
    return;
  }
  const HeadingRange& part = parts_[event.number];
  if (strips_.hide(edge.highest_tangent, part)) return;
  changed_ = true;
  for (WedgeStrip& strip : strips_.within(part)) {
    walk_to(strip, at, piece);
    // The building lies left of the edge: beyond it when the edge runs clockwise.
    if (edge.from_rad < edge.to_rad)
      enter(strip, event, at.height_m);
    else
      leave(strip, event);
  }
}

void SliceSweep::test(const SightPoint& point, const ProfilePoint& at, std::size_t piece) {
  WedgeStrip& strip = strips_.at(point.heading_rad);
  walk_to(strip, at, piece);
  const double tangent = point.height_m / point.distance_m;
  const bool in_a_building = strip.roofed && tangent * at.distance_m < strip.roof_m;
  sights_.clear[point.line] = tangent >= strip.horizon_tangent && !in_a_building ? 1 : 0;
}

void SliceSweep::enter(WedgeStrip& strip, const SliceEvent& event, double ground_m) {
  const CutEdge& edge = *event.edge;
  if (!strips_.enter(strip, edge.prism, edge.highest_tangent)) return;
  const double top_m = world_.solids().prisms[edge.prism].top_m - sensor_m_.z;
  if (strip.roofed && top_m <= strip.roof_m) return;
  const double below_m = strip.roofed ? std::max(strip.roof_m, ground_m) : ground_m;
  if (strip.roofed) close_roof(strip, event.distance_m);
  if (top_m > below_m) see_wall(strip, event, below_m, top_m);
  strip.roof_from_m = event.distance_m;
  strips_.find_roof(strip, world_.solids().prisms, sensor_m_.z);
}

void SliceSweep::leave(WedgeStrip& strip, const SliceEvent& event) {
  const CutEdge& edge = *event.edge;
  if (!strips_.leave(strip, edge.prism, edge.highest_tangent)) return;
  close_roof(strip, event.distance_m);
  strips_.find_roof(strip, world_.solids().prisms, sensor_m_.z);
}

void SliceSweep::walk_to(WedgeStrip& strip, const ProfilePoint& at, std::size_t piece) {
  walk_ground(strip, strip.walked, at, piece);
  strip.walked = at;
}

// Ground under a roof is hidden, ground that pokes through is not.
void SliceSweep::walk_ground(WedgeStrip& strip, const ProfilePoint& near, const ProfilePoint& far,
                             std::size_t piece) {
  if (!(far.distance_m > near.distance_m)) return;
  if (!strip.roofed) {
    see_ground(strip, near, far, piece);
    return;
  }
  const double roof_m = strip.roof_m;
  if (near.height_m <= roof_m && far.height_m <= roof_m) return;
  if (near.height_m >= roof_m && far.height_m >= roof_m) {
    close_roof(strip, near.distance_m);
    see_ground(strip, near, far, piece);
    strip.roof_from_m = far.distance_m;
    return;
  }
  const double share = (roof_m - near.height_m) / (far.height_m - near.height_m);
  const ProfilePoint at{near.distance_m + (far.distance_m - near.distance_m) * share, roof_m};
  if (near.height_m < roof_m) {
    close_roof(strip, at.distance_m);
    see_ground(strip, at, far, piece);
    strip.roof_from_m = far.distance_m;
  } else {
    close_roof(strip, near.distance_m);
    see_ground(strip, near, at, piece);
    strip.roof_from_m = at.distance_m;
  }
}

// Which part of the wedge piece `i` stands for.
void SliceSweep::set_part(int i, const HeadingRange& part) {
  const double wedge_rad = wedge_.slice().width_rad, left_rad = wedge_.range().left_rad;
  pieces_->share[i] = strips_.one() ? 1.0 : part.width_rad() / wedge_rad;
  pieces_->left[i] = strips_.one() ? 0.0 : (part.left_rad - left_rad) / wedge_rad;
}

int SliceSweep::next_piece() {
  if (pieces_->full()) (*full_)(*pieces_);
  return pieces_->count++;
}

void SliceSweep::see_ground(WedgeStrip& strip, ProfilePoint near, const ProfilePoint& far,
                            std::size_t piece) {
  if (!visible(strip, near, far)) return;
  changed_ = true;
  if (far.height_m < darkest_tangent_ * far.distance_m) return;
  const GroundCut::Cell& cell = cut_.cells[piece];
  const double* sw = &ground_->height_m[ground_->post(cell.column, cell.row)];
  const std::ptrdiff_t stride = ground_->columns;
  const double per_m = 1.0 / ground_->spacing_m;
  const double ne = sw[stride + 1];
  const double gx = (cell.upper ? ne - sw[stride] : sw[1] - sw[0]) * per_m;
  const double gy = (cell.upper ? sw[stride] - sw[0] : ne - sw[1]) * per_m;
  const glm::dvec2& along = wedge_.slice().along;
  const double slope = gx * along.x + gy * along.y;
  // The facet's plane passes this far below the sensor.
  const double below_m = slope * far.distance_m - far.height_m;
  const double middle_m = (near.distance_m + far.distance_m) / 2;
  const terrain::SurfaceMap::Cover cover = map_->cover_in_cell(
      cell.column, cell.row, sensor_m_.x + along.x * middle_m, sensor_m_.y + along.y * middle_m);
  const int i = next_piece();
  pieces_->near_distance_m[i] = near.distance_m;
  pieces_->near_height_m[i] = near.height_m;
  pieces_->far_distance_m[i] = far.distance_m;
  pieces_->far_height_m[i] = far.height_m;
  pieces_->cross_m2[i] = below_m * (far.distance_m - near.distance_m);
  pieces_->facet_m[i] = below_m;
  pieces_->facet_d2[i] = 1.0 + gx * gx + gy * gy;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  pieces_->material[i] = cover.material;
  pieces_->object[i] = cover.object;
  set_part(i, strip.range);
}

void SliceSweep::close_roof(WedgeStrip& strip, double distance_m) {
  const double roof_m = strip.roof_m;
  ProfilePoint near{strip.roof_from_m, roof_m};
  strip.roof_from_m = distance_m;
  if (!(distance_m > near.distance_m) || !visible(strip, near, {distance_m, roof_m})) return;
  const int i = next_piece();
  pieces_->near_distance_m[i] = near.distance_m;
  pieces_->near_height_m[i] = roof_m;
  pieces_->far_distance_m[i] = distance_m;
  pieces_->far_height_m[i] = roof_m;
  pieces_->cross_m2[i] = -roof_m * (distance_m - near.distance_m);
  pieces_->facet_m[i] = -roof_m;
  pieces_->facet_d2[i] = 1.0;
  pieces_->nearer_m[i] = pieces_->farther_m[i] = 0.0;
  pieces_->material[i] = strip.roof_material;
  pieces_->object[i] = strip.roof_object;
  set_part(i, strip.range);
}

void SliceSweep::see_wall(WedgeStrip& strip, const SliceEvent& event, double low_m, double top_m) {
  const double horizon_tangent = strip.horizon_tangent;
  if (!(top_m > std::max(low_m, horizon_tangent * event.distance_m))) return;
  // The same for all strips under one wall, or they would never be alike again.
  strip.horizon_tangent = top_m / event.distance_m;
  const CutEdge& edge = *event.edge;
  const WallPart part = wedge_.wall(edge, strip.range);
  const double from_m = std::max(low_m, horizon_tangent * part.distance_m);
  if (top_m > from_m)
    add_wall(part, from_m, top_m, strip.range, world_.solids().prisms[edge.prism]);
}

void SliceSweep::add_wall(const WallPart& part, double from_m, double top_m,
                          const HeadingRange& range, const terrain::Solid& prism) {
  const double distance_m = part.distance_m;
  const double range_per_distance = distance_m / std::sqrt(distance_m * distance_m + top_m * top_m);
  const int parts =
      parts_of(distance_m * (top_m - from_m),
               distance_m * distance_m + std::min(from_m * from_m, top_m * top_m),
               most_elevation_rad(world_.sensor.antenna.elevation.half_power_width_rad));
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
    pieces_->right_nearer[i] = part.right_nearer ? 1 : 0;
    pieces_->material[i] = prism.wall;
    pieces_->object[i] = prism.object;
    set_part(i, range);
  }
}

}  // namespace fanbeam::renderer
