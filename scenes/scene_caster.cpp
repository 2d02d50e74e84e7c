#include "scenes/scene_caster.h"

namespace fanbeam::scenes {

renderer::CasterChoice scene_caster(const SceneDescription& scene,
                                    const std::optional<renderer::CasterWish>& asked,
                                    const FlightVolume& volume, const terrain::Solids& solids,
                                    const core::EffectPlan& plan, core::ProblemList& problems) {
  const sensors::Scan& scan = scene.sensor.scan;
  const renderer::CasterFacts facts{
      .buildings = solids.prisms.size(),
      .others = solids.others.size(),
      .double_bounce = plan.runs(core::EffectId::double_bounce),
      .stabilised = scan.stabilised,
      .plane_scan = scan.surface == sensors::ScanSurface::plane,
      .least_vertical_turn_rad = volume.least_vertical_turn_rad,
      .vertical_turn_rad = volume.vertical_turn_rad,
      .fan_rad = scan.field_of_view_rad + 2.0 * scene.sensor.antenna.azimuth.cut_rad};
  try {
    return asked ? renderer::choose_caster(*asked, facts)
                 : renderer::choose_caster(scene.caster, facts, scene.caster_place);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return {};
  }
}

}  // namespace fanbeam::scenes
