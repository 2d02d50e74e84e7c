// What a figure says beside its pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/pose.h"
#include "scenes/scene.h"
#include "session/figure/runway_view.h"

namespace fanbeam::session {

// A length's unit on a scale and in a text.
struct RangeUnit {
  const char* name = "m";
  double metres = 1.0;
};

inline constexpr std::array<const char*, 3> kRangeUnits = {"m", "km", "NM"};

// One of kRangeUnits; for an empty wish km for a sensor that sees farther than 2 km, m for others.
RangeUnit range_unit(const std::string& wish, const sensors::RangeGate& gate);

// "3.21 km", "870 m", "1.73 NM": three figures.
std::string length_text(double length_m, const RangeUnit& unit);

struct FigureFacts {
  std::string title, scene, sensor;
  std::string frame, time;
  std::string position, height, speed;
  std::string heading, pitch, roll;
  RangeUnit unit;
  bool aircraft = true;  // false for a sensor that sees less than 2 km, as those of cars do
  std::vector<RunwayView> runways;
  // Elevation of the local horizontal in the antenna's frame, at the scan's left and right edge.
  double horizon_left_rad = 0.0, horizon_right_rad = 0.0;
  // Elevation of the antenna's peak from the local horizontal, straight ahead.
  double boresight_above_level_rad = 0.0;
};

FigureFacts figure_facts(const scenes::Scene& scene, const core::Pose& pose, int frame,
                         const std::string& unit_wish);

}  // namespace fanbeam::session
