#include "scenes/scene_caster.h"

namespace fanbeam::scenes {
namespace {

renderer::CasterChoice chosen(const SceneDescription& scene,
                              const std::optional<renderer::CasterWish>& asked,
                              const FlightVolume& volume, const terrain::Solids& solids,
                              bool double_bounce) {
  const sensors::Scan& scan = scene.sensor.scan;
  const renderer::CasterFacts facts{
      .buildings = solids.prisms.size(),
      .others = solids.others.size(),
      .double_bounce = double_bounce,
      .stabilised = scan.stabilised,
      .plane_scan = scan.surface == sensors::ScanSurface::plane,
      .least_vertical_turn_rad = volume.least_vertical_turn_rad,
      .vertical_turn_rad = volume.vertical_turn_rad,
      .fan_rad = scan.field_of_view_rad + 2.0 * scene.sensor.antenna.azimuth.cut_rad};
  return asked ? renderer::choose_caster(*asked, facts)
               : renderer::choose_caster(scene.caster, facts, scene.caster_place);
}

}  // namespace

void check_caster(const SceneDescription& scene, const std::optional<renderer::CasterWish>& asked,
                  const FlightVolume& volume, const terrain::Solids& solids,
                  core::ProblemList& problems) {
  try {
    chosen(scene, asked, volume, solids, false);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
}

renderer::CasterChoice scene_caster(const SceneDescription& scene,
                                    const std::optional<renderer::CasterWish>& asked,
                                    const FlightVolume& volume, const terrain::Solids& solids,
                                    const core::EffectPlan& plan) {
  return chosen(scene, asked, volume, solids, plan.runs(core::EffectId::double_bounce));
}

}  // namespace fanbeam::scenes
