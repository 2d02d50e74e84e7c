// Looks at built scenes: what lies where.
#pragma once

#include <catch2/catch.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "core/units.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

inline const glm::dvec3 kDown(0.0, 0.0, -1.0);

struct Seen {
  double up_m = 0.0;
  std::string material;
};

// What a ray from 1 km above meets first.
inline Seen seen_from_above(const scenes::Scene& scene, glm::dvec2 position_m) {
  const auto hit = scene.world.surfaces().intersect(glm::dvec3(position_m, 1000.0), kDown, 3000.0);
  REQUIRE(hit.has_value());
  return {1000.0 - hit->distance_m, scene.world.geometry->material_names.at(hit->material)};
}

inline glm::dvec2 local_m(const scenes::Scene& scene, double latitude_deg, double longitude_deg) {
  return scene.frame.to_local_m(
      {core::radians(latitude_deg), core::radians(longitude_deg), scene.frame.origin().height_m});
}

inline double ground_m(const scenes::Scene& scene, glm::dvec2 position_m) {
  return scene.world.surfaces().terrain()->height_at(position_m.x, position_m.y).value();
}

// Height above the scene's datum of the terrain there.
inline double height_m(const scenes::Scene& scene, glm::dvec2 position_m) {
  return scene.frame.to_geodetic(glm::dvec3(position_m, ground_m(scene, position_m))).height_m;
}

inline const std::string kFixed = R"([trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)";

// The small scene with a standing radar.
inline std::string standing() {
  return kSmallScene.substr(0, kSmallScene.find("[trajectory.ils]")) + kFixed;
}

}  // namespace fanbeam::tests
