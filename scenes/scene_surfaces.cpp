#include "scenes/scene_surfaces.h"

#include <algorithm>

#include "atmosphere/air_column.h"
#include "renderer/casting/nrcs_table.h"

namespace fanbeam::scenes {

using materials::MaterialLibrary;
using materials::SurfaceState;

namespace {

constexpr double kNoFiniteChange_dB = 3000.0;

// As the ray caster sees the surface.
renderer::NrcsTable table_of(const SceneDescription& scene, const materials::SurfaceModel& model) {
  const sensors::Waveform& waveform = scene.sensor.waveform;
  return renderer::NrcsTable(
      materials::NrcsCurve(model, waveform.polarisation, waveform.frequency_Hz));
}

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

double state_change_dB(const SceneDescription& scene, const MaterialLibrary& library,
                       const std::set<std::size_t>& used) {
  double largest_dB = 0.0;
  for (const std::size_t index : used) {
    const std::size_t other = library.in_state(index, scene.surface_state);
    if (other == index) continue;
    const double change_dB = table_of(scene, library[other].model)
                                 .largest_change_dB(table_of(scene, library[index].model));
    // A perfectly dark material has no finite change: the whole window may be at stake.
    largest_dB = std::max(largest_dB, std::min(change_dB, kNoFiniteChange_dB));
  }
  return largest_dB;
}

void add_surface_facts(const SceneDescription& scene, const MaterialLibrary& library,
                       const std::set<std::size_t>& used, const ModelMaterials& model_materials,
                       renderer::SceneFacts& facts) {
  facts.surface_not_dry = scene.surface_state != SurfaceState::dry;
  facts.surface_change_dB = state_change_dB(scene, library, used);
  const auto brightest = [&](const materials::SurfaceModel& model) {
    facts.largest_sigma0_over_sine =
        std::max(facts.largest_sigma0_over_sine, table_of(scene, model).largest());
  };
  for (const std::size_t index : used) {
    const materials::Material& dry = library[index];
    const materials::Material& turned = library[library.in_state(index, scene.surface_state)];
    facts.state_changes_mirrors = facts.state_changes_mirrors ||
                                  dry.dielectric != turned.dielectric ||
                                  dry.rms_height_m != turned.rms_height_m;
    brightest(dry.model);
    if (&turned != &dry) brightest(turned.model);
  }
  for (const ModelMaterials::Entry& entry : model_materials.all()) brightest(entry.surface);
}

}  // namespace fanbeam::scenes
