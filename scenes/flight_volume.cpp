#include "scenes/flight_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

constexpr FlightVolume kNowhere{1e300, 1e300, -1e300, -1e300, 1e300, -1e300, 1e300, 0.0};

constexpr double kBulge_m = 8.0 * 6.33e6;  // d^2 / 8 R, of the smallest radius

double turn_rad(const terrain::LocalFrame& frame, const core::Geodetic& at) {
  const glm::dvec3 down = frame.north_east_down_at(at)[2];
  return std::atan2(std::hypot(down.x, down.y), -down.z);
}

// Of a height in the scene's datum, over the place that `at_m` stands for.
double local_up_m(const terrain::LocalFrame& frame, const SceneDescription& scene,
                  const glm::dvec3& at_m, double height_m) {
  core::Geodetic at = frame.to_geodetic(at_m);
  at.height_m = height_m;
  at.height_m = terrain::ellipsoidal_height_m(at, scene.datum);
  return frame.to_local_m(at).z;
}

FlightVolume both(const FlightVolume& a, const FlightVolume& b) {
  return {std::min(a.west_m, b.west_m),
          std::min(a.south_m, b.south_m),
          std::max(a.east_m, b.east_m),
          std::max(a.north_m, b.north_m),
          std::min(a.lowest_m, b.lowest_m),
          std::max(a.highest_m, b.highest_m),
          std::min(a.least_vertical_turn_rad, b.least_vertical_turn_rad),
          std::max(a.vertical_turn_rad, b.vertical_turn_rad)};
}

FlightVolume volume_of(const Trajectory& trajectory, const terrain::LocalFrame& frame) {
  FlightVolume volume = kNowhere;
  std::optional<glm::dvec3> before_m;
  for (const core::Pose& pose : trajectory.poses()) {
    const glm::dvec3 at_m = frame.to_local_m(pose.position);
    // Between two poses the path bulges with the Earth.
    if (before_m)
      volume.highest_m =
          std::max(volume.highest_m, std::max(before_m->z, at_m.z) +
                                         glm::dot(at_m - *before_m, at_m - *before_m) / kBulge_m);
    before_m = at_m;
    volume.west_m = std::min(volume.west_m, at_m.x);
    volume.east_m = std::max(volume.east_m, at_m.x);
    volume.south_m = std::min(volume.south_m, at_m.y);
    volume.north_m = std::max(volume.north_m, at_m.y);
    volume.lowest_m = std::min(volume.lowest_m, at_m.z);
    volume.highest_m = std::max(volume.highest_m, at_m.z);
    const double turned_rad = turn_rad(frame, pose.position);
    volume.least_vertical_turn_rad = std::min(volume.least_vertical_turn_rad, turned_rad);
    volume.vertical_turn_rad = std::max(volume.vertical_turn_rad, turned_rad);
  }
  return volume;
}

// Over all of `ground`, between the heights that the description states or those of flight_volume.h.
FlightVolume volume_over(const terrain::HeightField& ground, const SiteFacts& site,
                         const terrain::LocalFrame& frame, const SceneDescription& scene) {
  FlightVolume volume{ground.west_m, ground.south_m, ground.east_m(), ground.north_m()};
  volume.lowest_m = site.lowest_ground_m;
  volume.highest_m = site.highest_ground_m + scene.sensor.range.maximum_m();
  const std::array<glm::dvec3, 5> places{{{0.0, 0.0, 0.0},
                                          {volume.west_m, volume.south_m, 0.0},
                                          {volume.west_m, volume.north_m, 0.0},
                                          {volume.east_m, volume.south_m, 0.0},
                                          {volume.east_m, volume.north_m, 0.0}}};
  const glm::dvec3 nearest_m(std::clamp(0.0, volume.west_m, volume.east_m),
                             std::clamp(0.0, volume.south_m, volume.north_m), 0.0);
  volume.least_vertical_turn_rad = turn_rad(frame, frame.to_geodetic(nearest_m));
  double stated_lowest_m = 1e300, stated_highest_m = -1e300;
  for (const glm::dvec3& at_m : places) {
    volume.vertical_turn_rad =
        std::max(volume.vertical_turn_rad, turn_rad(frame, frame.to_geodetic(at_m)));
    const FlightHeights& stated = scene.flight_heights;
    if (stated.lowest_m)
      stated_lowest_m = std::min(stated_lowest_m, local_up_m(frame, scene, at_m, *stated.lowest_m));
    if (stated.highest_m)
      stated_highest_m =
          std::max(stated_highest_m, local_up_m(frame, scene, at_m, *stated.highest_m));
  }
  if (scene.flight_heights.lowest_m) volume.lowest_m = stated_lowest_m;
  if (scene.flight_heights.highest_m) volume.highest_m = stated_highest_m;
  return volume;
}

}  // namespace

FlightVolume flight_volume(const SceneDescription& scene, const terrain::LocalFrame& frame,
                           const std::optional<Trajectory>& trajectory,
                           const terrain::HeightField& ground, const SiteFacts& site) {
  const bool stated = scene.flight_heights.stated || !trajectory;
  FlightVolume volume = stated ? volume_over(ground, site, frame, scene) : FlightVolume{};
  if (!trajectory) return volume;
  const FlightVolume flown = volume_of(*trajectory, frame);
  return stated ? both(volume, flown) : flown;
}

}  // namespace fanbeam::scenes
