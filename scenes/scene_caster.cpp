#include "scenes/scene_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace fanbeam::scenes {

renderer::CasterFacts caster_facts(const sensors::Sensor& sensor, const terrain::LocalFrame& frame,
                                   const Trajectory& trajectory, const terrain::HeightField& ground,
                                   const terrain::Solids& solids) {
  renderer::CasterFacts facts{.has_ground = !ground.height_m.empty(),
                              .buildings = solids.prisms.size(),
                              .others = solids.others.size(),
                              .stabilised = sensor.scan.stabilised,
                              .plane_scan = sensor.scan.surface == sensors::ScanSurface::plane};
  facts.fan_rad = sensor.scan.field_of_view_rad + 2.0 * sensor.antenna.azimuth.cut_rad;
  for (const core::Pose& pose : trajectory.poses()) {
    const glm::dvec3 down = frame.north_east_down_at(pose.position)[2];
    facts.vertical_turn_rad =
        std::max(facts.vertical_turn_rad, std::atan2(std::hypot(down.x, down.y), -down.z));
  }
  return facts;
}

renderer::CasterChoice scene_caster(const SceneDescription& scene,
                                    const std::optional<renderer::CasterWish>& asked,
                                    const renderer::CasterFacts& facts,
                                    core::ProblemList& problems) {
  try {
    return asked ? renderer::choose_caster(*asked, facts)
                 : renderer::choose_caster(scene.caster, facts, scene.caster_place);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return {};
  }
}

}  // namespace fanbeam::scenes
