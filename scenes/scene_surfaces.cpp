#include "scenes/scene_surfaces.h"

#include <algorithm>

#include "atmosphere/air_column.h"
#include "renderer/surfaces/nrcs_table.h"

namespace fanbeam::scenes {

using materials::MaterialLibrary;
using materials::SurfaceState;

namespace {

constexpr double kNoFiniteChange_dB = 3000.0;

}  // namespace

void read_surfaces(core::ConfigTable& root, SceneDescription& scene) {
  scene.allow_extrapolation = root.table("materials").boolean("allow_extrapolation", false);
  scene.surface_state = static_cast<SurfaceState>(
      root.table("weather").choice("surface", {"dry", "wet", "dry-snow", "wet-snow"}, 0));
}

void check_surfaces(const SceneDescription& scene, const MaterialLibrary& library,
                    const std::set<std::size_t>& used, core::ProblemList& problems) {
  std::set<std::size_t> shown = used;
  for (const std::size_t index : used) shown.insert(library.in_state(index, scene.surface_state));
  for (const std::size_t index : shown)
    library.report_extrapolations(index, scene.sensor.waveform.polarisation,
                                  scene.sensor.waveform.frequency_Hz, scene.allow_extrapolation,
                                  problems);
}

double surface_temperature_K(const SceneDescription& scene) {
  return atmosphere::AirColumn(scene.weather).at(0.0).temperature_K;
}

std::vector<SurfaceRecord> record_surfaces(const SceneDescription& scene,
                                           const MaterialLibrary& library,
                                           const std::set<std::size_t>& used, SurfaceState state) {
  std::vector<SurfaceRecord> records;
  for (const std::size_t index : used) {
    const materials::Material& shown = library[library.in_state(index, state)];
    records.push_back({library[index].name, shown.name, std::string(name_of(shown.model)),
                       name_of(shown.confidence), validity_of(shown.model).grazing_rad,
                       extrapolations_of(shown.model, scene.sensor.waveform.polarisation,
                                         scene.sensor.waveform.frequency_Hz)});
  }
  return records;
}

void add_surface_facts(const Site& site, SurfaceState state, renderer::SceneFacts& facts) {
  const MaterialLibrary& library = site.parts().library;
  const std::vector<renderer::NrcsTable>& dry = site.reflectivity(SurfaceState::dry).tables();
  const std::vector<renderer::NrcsTable>& shown = site.reflectivity(state).tables();
  facts.surface_not_dry = state != SurfaceState::dry;
  for (const std::size_t index : site.parts().used) {
    const std::size_t turned = library.in_state(index, state);
    if (turned == index) continue;
    // A perfectly dark material has no finite change: the whole window may be at stake.
    const double change_dB =
        std::min(shown[index].largest_change_dB(dry[index]), kNoFiniteChange_dB);
    facts.surface_change_dB = std::max(facts.surface_change_dB, change_dB);
    // What a surface scatters it cannot mirror (renderer/surfaces/mirrors.h): a little more may be all
    // that was left.
    const bool mirrors = library[index].rms_height_m && !library[index].dielectric.empty();
    facts.state_changes_mirrors = facts.state_changes_mirrors || (mirrors && change_dB > 0.0) ||
                                  library[index].dielectric != library[turned].dielectric ||
                                  library[index].rms_height_m != library[turned].rms_height_m;
  }
  for (const auto* tables : {&dry, &shown})
    for (const renderer::NrcsTable& table : *tables)
      facts.largest_sigma0_over_sine = std::max(facts.largest_sigma0_over_sine, table.largest());
}

}  // namespace fanbeam::scenes
