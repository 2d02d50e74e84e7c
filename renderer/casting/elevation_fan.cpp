#include "renderer/casting/elevation_fan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/casting/fan_layout.h"
#include "renderer/casting/heading.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

// Ranges before the first and behind the last cell that still get rays, so that border cells are
// full.
constexpr int kMarginCells = 2;
// Between headings that are searched for what stands above the ground; wider ones lie farther apart.
constexpr int kMostGaps = 512;
constexpr double kHorizonMargin_rad[] = {3e-4, 1.2e-3};
// So little of a column below its lowest direction is left out, as a level antenna has it.
constexpr double kLeastBelow_rad = 1e-3;
// An azimuth of a cone that goes down, but rises by less from end to end, has one range.
constexpr double kLeastRise = 0.02;

glm::dvec2 heading_at(const sensors::AntennaFrame& frame, double azimuth_rad, double elevation_rad,
                      sensors::ScanSurface surface) {
  return horizontal(sensors::direction(frame, azimuth_rad, elevation_rad, surface));
}

// What a cone's border reaches beyond 90 deg aside is no other direction.
bool lies_beyond(sensors::ScanSurface surface, double azimuth_rad) {
  return surface == sensors::ScanSurface::cone && std::cos(azimuth_rad) <= 0.0;
}

// Tangent of the elevation as the scan counts it (sensors/antenna/antenna_frame.h); rises with it.
double slope_of(const sensors::AntennaFrame& frame, const glm::dvec3& relative_m,
                sensors::ScanSurface surface) {
  const double forward = glm::dot(relative_m, frame.forward);
  const double right = glm::dot(relative_m, frame.right);
  const double along = surface == sensors::ScanSurface::cone
                           ? std::max(forward, 1e-6)
                           : std::sqrt(forward * forward + right * right);
  return glm::dot(relative_m, frame.up) / along;
}

// The vertical part of an azimuth's directions e, forward and up in its own plane:
// along cos e + up sin e + across.
struct VerticalPart {
  double along, up, across;

  double lowest_rad() const { return std::atan2(-up, -along); }
  double rise() const { return std::hypot(along, up); }
  bool is_even() const { return rise() < kLeastRise && across < -kLeastRise; }
};

VerticalPart vertical_part(const sensors::AntennaFrame& frame, double azimuth_rad,
                           sensors::ScanSurface surface) {
  const double ca = std::cos(azimuth_rad), across = std::sin(azimuth_rad) * frame.right.z;
  const bool cone = surface == sensors::ScanSurface::cone;
  return {ca * frame.forward.z + (cone ? 0.0 : across), cone ? ca * frame.up.z : frame.up.z,
          cone ? across : 0.0};
}

// Where an azimuth meets what lies `lower_m` below, `range_m` away: above its lowest direction, and
// below. In that direction where it is too near for any other.
struct Meetings {
  double above_rad, below_rad;
  bool too_near;

  double in_front_rad() const {
    return std::abs(above_rad) <= std::abs(below_rad) ? above_rad : below_rad;
  }
};

Meetings meetings(const VerticalPart& part, double lower_m, double range_m) {
  const double down = -lower_m / std::max(range_m, 1e-9) - part.across;
  const double half_rad = std::acos(std::clamp(down / std::max(part.rise(), 1e-9), -1.0, 1.0));
  const double highest_rad = std::atan2(part.up, part.along);
  return {std::remainder(highest_rad - half_rad, 2.0 * core::kPi),
          std::remainder(highest_rad + half_rad, 2.0 * core::kPi), down < -part.rise()};
}

// Rays per step need not be whole: steps, from 1 on, take turns.
int rays_of_step(int step, double rays) {
  return static_cast<int>(std::floor(step * rays) - std::floor((step - 1) * rays));
}

}  // namespace

ElevationFan::ElevationFan(const World& world, const Sampling& sampling, Nearest nearest)
    : world_(world), sampling_(sampling), nearest_(nearest) {
  const sensors::Antenna& antenna = world.sensor.antenna;
  const double reach_rad = sensors::reach_rad(antenna.elevation);
  lowest_rad_ = std::max(antenna.boresight_elevation_rad - reach_rad, -core::kPi / 2);
  highest_rad_ = std::min(antenna.boresight_elevation_rad + reach_rad, core::kPi / 2);
  // The power of a ray is spread over its step: a narrow beam is sampled by parts of its width.
  constexpr double kStepsPerBeam = 32.0;
  sampling_.largest_step_rad =
      std::min(sampling.largest_step_rad, antenna.elevation.half_power_width_rad / kStepsPerBeam);
  const sensors::Display& display = world.sensor.display;
  object_step_rad_ =
      std::min(sampling_.largest_step_rad,
               sampling.largest_step_rows * display.cscope_span_rad / display.cscope_rows);
}

void ElevationFan::place(const sensors::AntennaFrame& frame, double left_rad, double right_rad,
                         std::vector<double>& edges) const {
  if (holds_lowest(frame, (left_rad + right_rad) / 2)) {
    place_both_ways(frame, left_rad, right_rad, edges);
    return;
  }
  edges.clear();
  if (world_.surfaces().terrain() != nullptr) {
    const glm::dvec3& at_m = frame.position_m;
    if (nearest_ == Nearest::antenna || !world_.surfaces().terrain()->height_at(at_m.x, at_m.y))
      edges.push_back(lowest_rad_);
  }
  climb(frame, left_rad, right_rad, Way::in_front, highest_rad_, edges);
}

bool ElevationFan::holds_lowest(const sensors::AntennaFrame& frame, double azimuth_rad) const {
  const sensors::ScanSurface surface = world_.sensor.scan.surface;
  if (azimuths_are_upright(frame, surface) || lies_beyond(surface, azimuth_rad)) return false;
  const VerticalPart part = vertical_part(frame, azimuth_rad, surface);
  return part.lowest_rad() > std::min(lowest_rad_, 0.0) + kLeastBelow_rad || part.is_even();
}

// What lies below the lowest direction lies above it for an antenna whose up axis is turned round.
void ElevationFan::place_both_ways(const sensors::AntennaFrame& frame, double left_rad,
                                   double right_rad, std::vector<double>& edges) const {
  const VerticalPart part =
      vertical_part(frame, (left_rad + right_rad) / 2, world_.sensor.scan.surface);
  if (part.is_even()) {
    edges.assign(1, lowest_rad_);
    add_until(highest_rad_, 1, object_step_rad_, edges);
    return;
  }
  const double from_rad = std::clamp(part.lowest_rad(), lowest_rad_, highest_rad_);
  sensors::AntennaFrame turned_round = frame;
  turned_round.up = -frame.up;
  edges.assign(1, -from_rad);
  climb(turned_round, left_rad, right_rad, Way::from_lowest, -lowest_rad_, edges);
  std::reverse(edges.begin(), edges.end());
  for (double& edge : edges) edge = -edge;
  climb(frame, left_rad, right_rad, Way::from_lowest, highest_rad_, edges);
  if (edges.size() < 2) edges.clear();
}

// Adds to what `edges` begin with, up to what shows highest and no farther than `end_rad`.
void ElevationFan::climb(const sensors::AntennaFrame& frame, double left_rad, double right_rad,
                         Way way, double end_rad, std::vector<double>& edges) const {
  const std::size_t begun = way == Way::from_lowest ? edges.size() : 0;
  if (world_.surfaces().terrain() != nullptr) {
    follow_ground(frame, (left_rad + right_rad) / 2, way, end_rad, edges);
    if (left_rad < right_rad && !azimuths_are_upright(frame, world_.sensor.scan.surface))
      for (const double azimuth_rad : {left_rad, right_rad})
        follow_beside(frame, azimuth_rad, way, end_rad, begun, edges);
    // Beside the centre azimuth the horizon may stand a little higher.
    for (const double margin_rad : kHorizonMargin_rad)
      if (edges.size() > begun)
        add_until(std::min(edges.back() + margin_rad, end_rad), 1, object_step_rad_, edges);
  }
  if (!world_.surfaces().has_meshes()) return;
  const double horizon_rad = edges.empty() ? lowest_rad_ : edges.back();
  const double top_rad = highest_object_rad(frame, left_rad, right_rad, horizon_rad, end_rad);
  if (edges.empty()) {
    if (top_rad <= lowest_rad_) return;
    edges.push_back(lowest_rad_);
  }
  add_until(std::min(top_rad, end_rad), 1, object_step_rad_, edges);
}

// A tilted antenna, or a cone, has the same range at another elevation in each azimuth. Of the ground under
// one beside the middle adds to `edges`, of which the middle one's are those from `begun` on, what lies
// before its first step ends and what lies above its last: there the gate begins and ends.
void ElevationFan::follow_beside(const sensors::AntennaFrame& frame, double azimuth_rad, Way way,
                                 double end_rad, std::size_t begun,
                                 std::vector<double>& edges) const {
  if (lies_beyond(world_.sensor.scan.surface, azimuth_rad)) return;
  thread_local std::vector<double> beside;
  const auto first = static_cast<std::ptrdiff_t>(begun), start = first > 0 ? first - 1 : first;
  beside.assign(edges.begin() + start, edges.begin() + first);
  follow_ground(frame, azimuth_rad, way, end_rad, beside);
  if (edges.size() > begun)
    edges.insert(edges.begin() + first, beside.begin() + (first - start),
                 std::lower_bound(beside.begin() + (first - start), beside.end(), edges[begun]));
  edges.insert(
      edges.end(),
      edges.empty() ? beside.begin() : std::upper_bound(beside.begin(), beside.end(), edges.back()),
      beside.end());
}

// Looks along headings near enough at the farthest range that nothing stands between two of them: from
// one azimuth to the other, and as far beside as those of a tilted antenna lean above `low_rad`.
double ElevationFan::highest_object_rad(const sensors::AntennaFrame& frame, double left_rad,
                                        double right_rad, double low_rad, double end_rad) const {
  const sensors::ScanSurface surface = world_.sensor.scan.surface;
  const bool level = azimuths_are_upright(frame, surface);
  const double middle_rad = (left_rad + right_rad) / 2;
  const glm::dvec2 middle = heading_at(frame, middle_rad, level ? 0.0 : low_rad, surface);
  // From the middle, clockwise.
  double first_rad = left_rad - middle_rad, last_rad = right_rad - middle_rad;
  if (!level)
    for (const double azimuth_rad : {left_rad, right_rad})
      for (const double elevation_rad : {low_rad, (low_rad + end_rad) / 2, end_rad}) {
        const double turned_rad =
            turn_rad(middle, heading_at(frame, azimuth_rad, elevation_rad, surface));
        first_rad = std::min(first_rad, turned_rad);
        last_rad = std::max(last_rad, turned_rad);
      }
  const double width_m = (last_rad - first_rad) * world_.sensor.range.maximum_m();
  const int gaps = std::clamp(static_cast<int>(std::ceil(width_m / terrain::RayScene::kTopsStep_m)),
                              2, kMostGaps);
  double top_rad = -core::kPi / 2;
  for (int i = 0; i <= gaps; ++i)
    top_rad = std::max(
        top_rad,
        highest_object_rad(frame, turned(middle, first_rad + (last_rad - first_rad) * i / gaps)));
  return top_rad;
}

void ElevationFan::follow_ground(const sensors::AntennaFrame& frame, double azimuth_rad, Way way,
                                 double end_rad, std::vector<double>& edges) const {
  const terrain::HeightField& ground = *world_.surfaces().terrain();
  const sensors::RangeGate& gate = world_.sensor.range;
  const double stride = std::max(1.0, 1.0 / sampling_.rays_per_cell);
  const glm::dvec3& sensor = frame.position_m;
  const sensors::ScanSurface surface = world_.sensor.scan.surface;
  const bool level = way == Way::in_front && azimuths_are_upright(frame, surface);
  const VerticalPart part = vertical_part(frame, azimuth_rad, surface);
  glm::dvec2 heading = heading_at(frame, azimuth_rad, 0.0, surface);
  const double below_m = std::abs(world_.surfaces().height_above_ground_m(sensor));
  double drop_m = below_m, lower_m = below_m;  // the second one negative for ground above
  bool too_near = false;                       // for this azimuth of a tilted antenna
  int step = 0;
  // Up from the lowest direction a row goes to the first step, which takes part of it for its own: a step
  // more keeps that out of the gate. The last step is as short as it must be.
  const bool bridge = way == Way::from_lowest && nearest_ == Nearest::first_cell;
  const double first_k = bridge ? -kMarginCells - 2.0 * stride : -kMarginCells;
  const double last_k = gate.cells + kMarginCells;
  for (double k = first_k; k <= last_k; k = k < last_k ? std::min(k + stride, last_k) : k + 1.0) {
    const double range_m = std::max(gate.minimum_m + gate.cell_m * k, 0.0);
    // A column of a tilted antenna, or a cone, runs over the ground in a curve: follow it.
    if (!level) {
      const Meetings meets = meetings(part, lower_m, range_m);
      const double to_rad = way == Way::in_front ? meets.in_front_rad() : meets.above_rad;
      if (way == Way::from_lowest && std::abs(to_rad) > core::kPi / 2) {
        if (to_rad < 0.0) continue;
        // The azimuth ends before this range, at the antenna's axis.
        if (!bridge || k > -kMarginCells) add_until(end_rad, 1, sampling_.largest_step_rad, edges);
        break;
      }
      // A cone has straight below in the lowest direction of every azimuth.
      too_near = meets.too_near && surface == sensors::ScanSurface::plane;
      heading = heading_at(frame, azimuth_rad, to_rad, surface);
    }
    // The ground distance of a slant range needs the height there: the one of the step before is
    // close enough. Nearer than the ground below there is the nadir, in another azimuth of a tilted
    // antenna.
    const double distance_m = std::sqrt(std::max(range_m * range_m - drop_m * drop_m, 1e-6));
    const double x_m = sensor.x + heading.x * distance_m, y_m = sensor.y + heading.y * distance_m;
    const std::optional<double> height_m = ground.height_at(x_m, y_m);
    // Beside the ground its border shows the way to it.
    const double up_m = height_m ? *height_m : ground.nearest_height(x_m, y_m);
    lower_m = sensor.z - up_m;
    drop_m = std::min(std::abs(lower_m), std::max(range_m, below_m));
    const glm::dvec3 relative_m(x_m - sensor.x, y_m - sensor.y, up_m - sensor.z);
    const double elevation_rad =
        too_near ? part.lowest_rad() : std::atan(slope_of(frame, relative_m, surface));
    if (!height_m) continue;
    const int parts = rays_of_step(++step, sampling_.rays_per_cell * stride);
    if (edges.empty()) {
      edges.push_back(std::clamp(elevation_rad, lowest_rad_, end_rad));
    } else if (bridge && step == 1 && k < -kMarginCells) {
      add_until(std::min(elevation_rad, end_rad), 1, core::kPi, edges);
    } else {
      add_until(std::min(elevation_rad, end_rad), parts, sampling_.largest_step_rad, edges);
    }
  }
}

double ElevationFan::highest_object_rad(const sensors::AntennaFrame& frame,
                                        const glm::dvec2& heading) const {
  const terrain::RayScene& surfaces = world_.surfaces();
  const glm::dvec3& sensor = frame.position_m;
  double top_slope = -1e30;
  constexpr double kStep_m = terrain::RayScene::kTopsStep_m;
  const double reach_m = surfaces.tops_reach_m();
  // A step beyond the last cell: steps do not end on it.
  const double farthest_m = world_.sensor.range.maximum_m() + kStep_m;
  for (double distance_m = 0.0; distance_m <= farthest_m; distance_m += kStep_m) {
    const double x_m = heading.x * distance_m;
    const double y_m = heading.y * distance_m;
    const double z_m = surfaces.mesh_top_m(sensor.x + x_m, sensor.y + y_m) - sensor.z;
    if (z_m < -1e29) continue;
    // The top may stand anywhere about: nearest when above the sensor, farthest when below.
    const double at_m = std::max(distance_m + (z_m > 0.0 ? -reach_m : reach_m), 1.0);
    const glm::dvec3 relative_m(heading.x * at_m, heading.y * at_m, z_m);
    top_slope = std::max(top_slope, slope_of(frame, relative_m, world_.sensor.scan.surface));
  }
  return std::atan(top_slope);
}

void ElevationFan::add_until(double elevation_rad, int parts, double largest_step_rad,
                             std::vector<double>& edges) const {
  const double from_rad = edges.back();
  const double span_rad = elevation_rad - from_rad;
  if (span_rad <= 0.0) return;
  const int count = std::max({1, parts, static_cast<int>(std::ceil(span_rad / largest_step_rad))});
  for (int i = 1; i <= count; ++i) edges.push_back(from_rad + span_rad * i / count);
}

}  // namespace fanbeam::renderer
