#include "scenes/plan_facts.h"

#include <algorithm>

#include "scenes/scene_surfaces.h"

namespace fanbeam::scenes {
namespace {

// Of the ground and what stands on it, the flight, and targets, which may hang higher than anything
// else.
void add_heights(const SceneParts& parts, renderer::SceneFacts& facts) {
  const auto [lowest, highest] =
      std::minmax_element(parts.ground.height_m.begin(), parts.ground.height_m.end());
  facts.lowest_m = *lowest;
  facts.highest_m = *highest;
  const auto pass = [&facts](double height_m) {
    facts.lowest_m = std::min(facts.lowest_m, height_m);
    facts.highest_m = std::max(facts.highest_m, height_m);
  };
  for (const terrain::PlacedMesh& body : parts.meshes)
    for (const glm::dvec3& vertex_m : body.mesh.vertices_m) pass(vertex_m.z);
  for (const core::Pose& pose : parts.trajectory.poses())
    pass(parts.frame.to_local_m(pose.position).z);
  for (const renderer::PointTarget& target : parts.targets)
    for (const renderer::PointTarget::Waypoint& waypoint : target.path) pass(waypoint.position_m.z);
}

bool targets_fluctuate(const SceneDescription& scene) {
  const auto fluctuates = [](const auto& described) {
    return described.swerling != core::Swerling::steady;
  };
  return std::any_of(scene.targets.begin(), scene.targets.end(), fluctuates) ||
         std::any_of(scene.lines.begin(), scene.lines.end(), fluctuates);
}

}  // namespace

renderer::SceneFacts facts_of(const SceneParts& parts, const atmosphere::Weather& weather,
                              double largest_eta_m2_per_m3) {
  renderer::SceneFacts facts;
  facts.weather = weather;
  facts.sensor = parts.description.sensor;
  facts.sample = parts.description.sample;
  facts.fluctuating_targets = targets_fluctuate(parts.description);
  facts.largest_eta_m2_per_m3 = largest_eta_m2_per_m3;
  add_heights(parts, facts);
  add_surface_facts(parts.description, parts.library, parts.used_materials, parts.model_materials,
                    facts);
  for (const renderer::PointTarget& target : parts.targets)
    facts.rcs_sum_m2 += materials::largest_rcs_m2(target.rcs, facts.sensor.wavelength_m());
  add_mirror_facts(parts.mirrors, parts.ground, parts.patches, parts.meshes, !parts.targets.empty(),
                   facts);
  return facts;
}

std::vector<bool> mirroring_materials(const std::vector<SpecularSurfaces>& mirrors) {
  std::vector<bool> mirroring;
  for (const SpecularSurfaces& surfaces : mirrors) {
    mirroring.resize(std::max(mirroring.size(), surfaces.size()), false);
    for (std::size_t id = 0; id < surfaces.size(); ++id)
      mirroring[id] = mirroring[id] || surfaces[id].has_value();
  }
  return mirroring;
}

}  // namespace fanbeam::scenes
