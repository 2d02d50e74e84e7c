// What the checks look at, and the checks themselves. Thresholds stand beside the checks; their
// reasons are in docs/doctor.md.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scenes/doctor/finding.h"
#include "scenes/natural_ground.h"
#include "scenes/objects.h"
#include "scenes/scene.h"
#include "sensors/antenna/antenna_frame.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

// A frame as far as the checks need it.
struct Sight {
  int frame = 0;
  sensors::AntennaFrame antenna;
  double above_ground_m = 0.0;
};

struct Body {
  terrain::PlacedMesh placed;
  std::string name;     // "scene.toml:30, model \"truck\""
  bool single = false;  // one thing, not a town of them
  bool floating = false;
};

struct DoctorParts {
  const Scene& scene;
  const std::vector<core::Problem>& warnings;
  const Ground& ground;
  const NaturalGround& natural;
  std::vector<Body> bodies;
  std::vector<PointGroup> point_groups;  // of scene.world.targets
  std::vector<Sight> flight;             // every frame
  std::vector<Sight> sights;             // at most kMostSights of them

  const sensors::Sensor& sensor() const { return scene.description.sensor; }
  // Where the ray caster sees a point: it counts heights from near the ground, and keeps floats.
  glm::dvec3 in_caster_m(const glm::dvec3& point_m) const {
    return scene.world.surfaces().in_caster_m(point_m);
  }
  // Sine of the depression at the farthest range, from the flight's median height.
  double far_sine = 0.01;
};

// "120 m east, -30 m north of the origin (52.12345, 10.54321)"
std::string place_text(const Scene& scene, const glm::dvec3& position_m);
// "scene.toml:30"
std::string place_text(const core::Place& place);

// Spacing of floats at the point's largest coordinate in the caster, at most.
double float_step_m(const DoctorParts& parts, const glm::dvec3& point_m);

// The point's range where the antenna's field of view and range window hold it, else 0.
double range_in_view_m(const DoctorParts& parts, const Sight& sight, const glm::dvec3& point_m);

void check_coordinates(const DoctorParts& parts, Findings& findings);
void check_triangle_sizes(const DoctorParts& parts, Findings& findings);
void check_duplicates(const DoctorParts& parts, Findings& findings);
void check_overlays(const DoctorParts& parts, Findings& findings);
void check_thin_bodies(const DoctorParts& parts, Findings& findings);
void check_targets(const DoctorParts& parts, Findings& findings);
void check_wires(const DoctorParts& parts, Findings& findings);
void check_runways(const DoctorParts& parts, Findings& findings);
void check_voids(const DoctorParts& parts, Findings& findings);
void check_flight_height(const DoctorParts& parts, Findings& findings);
void check_terrain_extent(const DoctorParts& parts, Findings& findings);
void check_grazing(const DoctorParts& parts, Findings& findings);
void check_accuracy(const DoctorParts& parts, Findings& findings);

}  // namespace fanbeam::scenes
