#include "scenes/scene_surfaces.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace fanbeam::scenes {

using materials::MaterialLibrary;
using materials::SurfaceState;

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
  constexpr int kAngles = 400;
  constexpr double kLowest_deg = 0.5;
  const sensors::Waveform& waveform = scene.sensor.waveform;
  double largest_dB = 0.0;
  for (const std::size_t index : used) {
    const std::size_t other = library.in_state(index, scene.surface_state);
    if (other == index) continue;
    const materials::NrcsCurve dry(library[index].model, waveform.polarisation,
                                   waveform.frequency_Hz);
    const materials::NrcsCurve turned(library[other].model, waveform.polarisation,
                                      waveform.frequency_Hz);
    for (int i = 0; i < kAngles; ++i) {
      const double angle_deg = kLowest_deg * std::pow(90.0 / kLowest_deg, i / (kAngles - 1.0));
      const double sine = std::sin(core::radians(angle_deg));
      const double change_dB = 10.0 * std::log10(turned.sigma0(sine) / dry.sigma0(sine));
      // A perfectly dark material has no finite change: the whole window may be at stake.
      largest_dB = std::max(largest_dB, std::isfinite(change_dB) ? std::abs(change_dB) : 3000.0);
    }
  }
  return largest_dB;
}

}  // namespace fanbeam::scenes
