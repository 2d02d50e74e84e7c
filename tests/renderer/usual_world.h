// What most worlds here are made of, and seen from.
#pragma once

#include "materials/nrcs/phong_nrcs.h"
#include "sensors/antenna/antenna_frame.h"
#include "tests/renderer/test_worlds.h"

namespace fanbeam::tests {

// Of the antenna, above the ground.
inline constexpr double kHeight_m = 60.0;

inline const materials::PhongNrcs kGrass(0.0325, 0.136, 1.99);
inline const materials::PhongNrcs kWall(0.05, 0.3, 4.0);
inline const materials::PhongNrcs kRough(0.05, 0.3, 3.0);
inline const materials::PhongNrcs kBlack;  // returns nothing

inline terrain::HeightField flat_ground() {
  return ground(4000.0, 250.0, [](double, double) { return 0.0; });
}

// Of level_pose.
inline sensors::AntennaFrame antenna_at(double height_m) {
  const renderer::FramePose pose = level_pose(height_m);
  return sensors::antenna_frame(pose.position_m, pose.north_east_down, pose.q_NB, {}, true);
}

}  // namespace fanbeam::tests
