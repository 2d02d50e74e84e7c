#include <cmath>
#include <glm/geometric.hpp>

#include "core/constants.h"
#include "scenes/duplicate_targets.h"
#include "scenes/line_points.h"
#include "scenes/near_field.h"
#include "scenes/objects.h"

namespace fanbeam::scenes {
namespace {

using renderer::PointTarget;

constexpr int kMostLinePoints = 100'000;
// Signals take 1e5 m/s, between a target and a radar that moves as well.
constexpr double kFastestLeg_mps = 5e4;

// Boresight `heading_rad` clockwise from north and `tilt_rad` up; y to the left of it, z up.
glm::dmat3 target_axes(double heading_rad, double tilt_rad) {
  const glm::dvec3 level(std::sin(heading_rad), std::cos(heading_rad), 0.0);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 x = std::cos(tilt_rad) * level + std::sin(tilt_rad) * up;
  const glm::dvec3 z = std::cos(tilt_rad) * up - std::sin(tilt_rad) * level;
  return {x, glm::cross(z, x), z};
}

// Of the points added since the last one.
void close_group(const std::string& name, const core::Place& place, PointTargets& targets,
                 bool is_line = false) {
  const std::size_t begin = targets.groups.empty() ? 0 : targets.groups.back().end;
  if (targets.points.size() > begin)
    targets.groups.push_back({name, place, is_line, begin, targets.points.size()});
}

void add_constant(const std::string& name, const glm::dvec3& position_m, double rcs_m2,
                  PointTargets& targets) {
  targets.points.push_back(
      {name, materials::ConstantRcs{rcs_m2}, {{0.0, position_m}}, glm::dmat3(1.0)});
}

void add_runway_reflectors(const RunwayDescription& description, const terrain::Runway& runway,
                           const Ground& ground, PointTargets& targets) {
  const auto add_sites = [&](const std::vector<terrain::ReflectorSite>& sites, const char* name,
                             double rcs_m2) {
    for (const terrain::ReflectorSite& site : sites)
      if (ground.field().height_at(site.position_m.x, site.position_m.y))
        add_constant(name, ground.on_ground_m(site.position_m, site.above_ground_m), rcs_m2,
                     targets);
    close_group(name, description.place, targets);
  };
  if (description.edge_lights)
    add_sites(terrain::edge_light_sites(runway), "runway light", description.light_rcs_m2);
  for (const std::string& name : description.approach_lights)
    if (const auto end = ground.landing_end(name))
      add_sites(
          terrain::approach_light_sites(*end->runway, end->end, description.approach_light_slope),
          "approach light", description.light_rcs_m2);
  if (description.fence_beyond_m > 0.0)
    add_sites(terrain::post_sites(terrain::perimeter(runway, description.fence_beyond_m), true,
                                  description.fence_spacing_m, description.fence_height_m),
              "fence post", description.fence_post_rcs_m2);
}

void add_line(const LineDescription& line, const Ground& ground, core::Polarisation polarisation,
              core::ProblemList& problems, PointTargets& targets) {
  const auto from = ground.local_m(line.from);
  const auto to = ground.local_m(line.to);
  if (!from || !to) return;
  const glm::dvec3 begin_m = ground.on_ground_m(*from, line.from_above_m);
  const glm::dvec3 end_m = ground.on_ground_m(*to, line.to_above_m);
  const int count = line_point_count(line, glm::length(end_m - begin_m));
  if (count > kMostLinePoints) {
    problems.error(core::ErrorClass::limit, line.place, "line",
                   "\"" + line.name + "\" of " + std::to_string(count) + " points",
                   "at most " + std::to_string(kMostLinePoints) + ": a wider spacing_m");
    return;
  }
  add_line_points(line, begin_m, end_m, polarisation, targets.points);
  close_group(line.name, line.place, targets, true);
}

bool stands_on_terrain(const Spot& at, const Ground& ground) {
  const glm::dvec2 at_m = ground.local_m(at.latitude_rad, at.longitude_rad);
  return ground.field().height_at(at_m.x, at_m.y).has_value();
}

// The way with a swing along it: speeds within 1.7 % of the largest.
std::vector<PointTarget::Waypoint> swung(const std::vector<PointTarget::Waypoint>& path,
                                         const TargetDescription::Swing& swing) {
  std::vector<PointTarget::Waypoint> result;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const PointTarget::Waypoint &from = path[i - 1], &to = path[i];
    const glm::dvec3 way_m = to.position_m - from.position_m;
    const double length_m = glm::length(way_m);
    const glm::dvec3 ahead = length_m > 0.0 ? way_m / length_m : glm::dvec3(0.0);
    const double duration_s = to.time_s - from.time_s;
    const double legs = swing.legs(duration_s);
    for (double leg = result.empty() ? 0.0 : 1.0; leg <= legs; ++leg) {
      const double time_s = leg == legs ? to.time_s : from.time_s + leg / legs * duration_s;
      const double offset_m =
          swing.amplitude_m * std::sin(2.0 * core::kPi * time_s / swing.period_s + swing.phase_rad);
      result.push_back({time_s, from.position_m + leg / legs * way_m + offset_m * ahead});
    }
  }
  return result;
}

// Tells the first leg that is too fast.
void check_speed(const PointTarget& target, const core::Place& place, core::ProblemList& problems) {
  for (std::size_t i = 1; i < target.path.size(); ++i) {
    const PointTarget::Waypoint &from = target.path[i - 1], &to = target.path[i];
    const double duration_s = to.time_s - from.time_s;
    if (!(duration_s > 0.0)) continue;  // told already
    const double speed_mps = glm::length(to.position_m - from.position_m) / duration_s;
    if (speed_mps <= kFastestLeg_mps) continue;
    problems.error(core::ErrorClass::range, place, "target",
                   "\"" + target.name + "\" at " + core::number_text(std::round(speed_mps)) +
                       " m/s from waypoint " + std::to_string(i - 1) + " to " + std::to_string(i),
                   "at most " + core::number_text(kFastestLeg_mps) + " m/s");
    return;
  }
}

void add_target(const TargetDescription& description, const Ground& ground,
                core::ProblemList& problems, PointTargets& targets) {
  PointTarget target{description.name,
                     description.rcs,
                     {},
                     target_axes(description.heading_rad, description.tilt_rad),
                     description.swerling};
  for (const TargetDescription::Waypoint& waypoint : description.path) {
    if (const auto at_m = ground.local_m(waypoint.at))
      target.path.push_back({waypoint.time_s, ground.on_ground_m(*at_m, waypoint.above_ground_m)});
  }
  // A waypoint that is nowhere has been told; what swings needs all of its way.
  const bool whole = target.path.size() == description.path.size();
  if (target.path.empty() || (description.swing && !whole)) return;
  if (whole) check_speed(target, description.place, problems);
  if (description.swing) target.path = swung(target.path, *description.swing);
  targets.points.push_back(std::move(target));
  close_group(description.name, description.place, targets);
}

}  // namespace

PointTargets build_targets(const SceneDescription& scene, const Ground& ground,
                           core::ProblemList& problems, std::size_t most_points) {
  PointTargets targets;
  const auto full = [&](const core::Place& place, const char* field) {
    if (targets.points.size() <= most_points) return false;
    problems.error(core::ErrorClass::limit, place, field,
                   "the scene's point targets: more than " + std::to_string(most_points),
                   "at most that: wider spacings");
    return true;
  };
  for (std::size_t i = 0; i < scene.runways.size(); ++i) {
    add_runway_reflectors(scene.runways[i], ground.runways()[i], ground, targets);
    if (full(scene.runways[i].place, "runway")) return targets;
  }
  for (const LightRowDescription& lights : scene.light_rows) {
    for (const core::Geodetic& at : lights.at) {
      const glm::dvec2 at_m = ground.local_m(at.latitude_rad, at.longitude_rad);
      if (ground.field().height_at(at_m.x, at_m.y))
        add_constant(lights.name, ground.on_ground_m(at_m, lights.above_ground_m), lights.rcs_m2,
                     targets);
    }
    close_group(lights.name, lights.place, targets);
    if (full(lights.place, "airport")) return targets;
  }
  NearField near_field(scene.sensor);
  for (const LineDescription& line : scene.lines) {
    const std::size_t before = targets.points.size();
    add_line(line, ground, scene.sensor.waveform.polarisation, problems, targets);
    if (targets.points.size() > before)
      near_field.look_at(targets.points.back().rcs, line.name, line.place);
    if (full(line.place, "line")) return targets;
  }
  for (const TargetDescription& target : scene.targets) {
    if (target.from_airport && !stands_on_terrain(target.path.front().at, ground)) continue;
    near_field.look_at(target.rcs, target.name, target.place);
    add_target(target, ground, problems, targets);
    if (full(target.place, "target")) return targets;
  }
  near_field.report(problems);
  tell_duplicate_targets(targets, scene.sensor.wavelength_m(), problems);
  return targets;
}

}  // namespace fanbeam::scenes
