// Where a place of the scene is in both pictures, by formula and not by echo.
//
//   x = (azimuth / field of view + 1/2) columns        both pictures, to the right
//   y = rows - (slant range - nearest) / cell           B-scope, downwards: the farthest range on top
//   y = (top - elevation) / span rows                   C-scope, downwards
// Angles are in the antenna's frame (sensors/antenna/antenna_frame.h). Pixel (0, 0) covers 0 to 1 in
// x and in y, so its middle is (0.5, 0.5). Positions outside a picture are given too, and a place beyond
// the range gate, or before it, is inside neither; a place beside or behind the antenna has none.
// Line of sight: a straight line past the scene's triangles to kSightHeight_m above the place, ended
// kSightClearance_m before it.
// Neglected: refraction.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/pose.h"
#include "renderer/frame_pose.h"
#include "scenes/scene.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::session {

inline constexpr double kSightClearance_m = 1.0, kSightHeight_m = 0.1;

struct PictureSpot {
  glm::dvec2 at_px{0.0};  // x, y
  bool inside = false;
};

struct PlaceLabel {
  core::Geodetic position;
  double range_m = 0.0;
  double bearing_rad = 0.0;  // from the antenna, true, 0 to 2 pi
  std::optional<double> azimuth_rad{}, elevation_rad{};
  std::optional<PictureSpot> bscope{}, cscope{};
  bool in_sight = false;  // nothing stands before it; whether a picture holds it or not
};

class Eye {
 public:
  // `scene` must outlive it.
  Eye(const scenes::Scene& scene, const core::Pose& pose);

  PlaceLabel look_at(const glm::dvec3& at_m) const;
  // The B-scope's part alone.
  std::optional<PictureSpot> in_bscope(const glm::dvec3& at_m) const;
  bool sees(const glm::dvec3& at_m, double clearance_m = kSightClearance_m) const;

  const glm::dvec3& at_m() const { return antenna_.position_m; }
  const scenes::Scene& scene() const { return scene_; }

 private:
  const sensors::Sensor& sensor() const { return scene_.description.sensor; }
  std::optional<sensors::AntennaAngles> angles_of(const glm::dvec3& at_m) const;
  PictureSpot bscope_spot(double azimuth_rad, double range_m) const;
  PictureSpot cscope_spot(double azimuth_rad, double elevation_rad, double range_m) const;

  const scenes::Scene& scene_;
  renderer::FramePose pose_;
  sensors::AntennaFrame antenna_;
};

}  // namespace fanbeam::session
