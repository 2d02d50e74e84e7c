#include "live/flights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/constants.h"
#include "core/errors.h"
#include "terrain/local_frame.h"

namespace fanbeam::live {
namespace {

constexpr std::array kRadii_m{2000.0, 1500.0, 1000.0};
constexpr double kSpeed_mps = 70.0, kGravity_mps2 = 9.80665;
constexpr double kWorthIt_m = 50.0;  // lower, for a tighter turn
constexpr double kOverGround_m = 120.0, kOverThreshold_m = 150.0;
constexpr int kPlaces = 360;  // of the circle, that the ground is looked at

// A circle in the scene's frame: at `phase` 0 over `start_m` along `course`.
struct Circle {
  glm::dvec2 start_m{0.0};
  glm::dvec2 course{0.0, 1.0};  // unit
  double radius_m = kRadii_m[0];
  double side = -1.0;  // -1 turns left, 1 right
  double height_m = 0.0;

  glm::dvec2 right() const { return {course.y, -course.x}; }
  glm::dvec2 at(double phase_rad) const {
    return start_m + radius_m * std::sin(phase_rad) * course +
           side * radius_m * (1.0 - std::cos(phase_rad)) * right();
  }
  glm::dvec2 along(double phase_rad) const {
    return std::cos(phase_rad) * course + side * std::sin(phase_rad) * right();
  }
};

double highest_ground_m(const scenes::Scene& scene, const Circle& circle) {
  double highest_m = -1e300;
  for (int i = 0; i < kPlaces; ++i) {
    const glm::dvec2 at_m = circle.at(2.0 * core::kPi * i / kPlaces);
    highest_m =
        std::max(highest_m, -scene.world.surfaces().height_above_ground_m({at_m.x, at_m.y, 0.0}));
  }
  return highest_m;
}

// The end of a runway that the scene's trajectory lands on, else the first.
Circle over_runway(const scenes::Scene& scene) {
  const scenes::RunwayPlace& runway = scene.runways.front();
  glm::dvec3 from_m = runway.ends[0].threshold_m, to_m = runway.ends[1].threshold_m;
  if (scene.trajectory) {
    const core::Pose last = scene.trajectory->at(scene.trajectory->end_s());
    const glm::dmat3 axes = scene.frame.north_east_down_at(last.position);
    if (glm::dot(axes * last.v_N_mps, to_m - from_m) < 0.0) std::swap(from_m, to_m);
  }
  Circle circle;
  circle.start_m = {from_m.x, from_m.y};
  circle.course = glm::normalize(glm::dvec2(to_m.x - from_m.x, to_m.y - from_m.y));
  circle.height_m = from_m.z + kOverThreshold_m;
  return circle;
}

// The lowest of those that both sides and a few radii offer, the widest first: a valley has room for
// a small one.
Circle circle_over(const scenes::Scene& scene) {
  const scenes::FlightVolume& volume = scene.volume;
  const double most_m =
      0.2 * std::min(volume.east_m - volume.west_m, volume.north_m - volume.south_m);
  Circle lowest;
  lowest.height_m = 1e300;
  for (const double radius_m : kRadii_m)
    for (const double side : {-1.0, 1.0}) {
      Circle circle;
      circle.height_m = -1e300;
      if (!scene.runways.empty()) circle = over_runway(scene);
      circle.radius_m = std::min(radius_m, most_m);
      circle.side = side;
      if (scene.runways.empty())
        circle.start_m = {0.5 * (volume.west_m + volume.east_m) - side * circle.radius_m,
                          0.5 * (volume.south_m + volume.north_m)};
      circle.height_m = std::max(circle.height_m, highest_ground_m(scene, circle) + kOverGround_m);
      if (circle.height_m < lowest.height_m - kWorthIt_m) lowest = circle;
    }
  return lowest;
}

}  // namespace

Flight circle(const scenes::Scene& scene) {
  return [circle = circle_over(scene), frame = scene.frame](double time_s) {
    const double bank_rad = std::atan(kSpeed_mps * kSpeed_mps / (kGravity_mps2 * circle.radius_m));
    const double phase_rad = kSpeed_mps * time_s / circle.radius_m;
    const glm::dvec2 at_m = circle.at(phase_rad), along = circle.along(phase_rad);
    core::Pose pose;
    pose.time_s = time_s;
    pose.position = frame.to_geodetic({at_m.x, at_m.y, circle.height_m});
    const glm::dmat3 axes = frame.north_east_down_at(pose.position);
    pose.v_N_mps = kSpeed_mps * glm::dvec3(along.x, along.y, 0.0) * axes;  // to north, east, down
    pose.q_NB = core::quaternion_from(
        {circle.side * bank_rad, 0.0, std::atan2(pose.v_N_mps.y, pose.v_N_mps.x)});
    return pose;
  };
}

Flight approach(const scenes::Scene& scene) {
  if (!scene.trajectory)
    core::throw_input_error(core::ErrorClass::ref, "--from", "ils", "a scene with a trajectory");
  return [trajectory = *scene.trajectory](double time_s) {
    const double length_s = trajectory.end_s() - trajectory.begin_s();
    core::Pose pose =
        trajectory.at(trajectory.begin_s() + (length_s > 0.0 ? std::fmod(time_s, length_s) : 0.0));
    pose.time_s = time_s;
    return pose;
  };
}

}  // namespace fanbeam::live
