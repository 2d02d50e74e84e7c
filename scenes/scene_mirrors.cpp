#include "scenes/scene_mirrors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "materials/dielectric/dielectric_medium.h"

namespace fanbeam::scenes {
namespace {

using materials::DielectricMedium;

// The nearest temperature that the medium's model knows (dielectric_medium.h).
double known_temperature_K(DielectricMedium medium, double temperature_K) {
  const auto known_K = materials::valid_temperature_K(medium);
  return known_K ? std::clamp(temperature_K, known_K->low, known_K->high) : temperature_K;
}

// The medium of a material that mirrors.
std::optional<DielectricMedium> mirroring_medium(const materials::Material& material) {
  if (!material.rms_height_m) return std::nullopt;
  return materials::dielectric_medium_named(material.dielectric);
}

double held_frequency_Hz(DielectricMedium medium, double frequency_Hz) {
  const materials::Interval known_Hz = materials::valid_frequency_Hz(medium);
  return std::clamp(frequency_Hz, known_Hz.low, known_Hz.high);
}

std::string text_GHz(double frequency_Hz) { return core::number_text(frequency_Hz / 1e9); }

}  // namespace

SpecularSurfaces specular_surfaces(const SceneDescription& scene, const Site& site,
                                   materials::SurfaceState state) {
  const materials::MaterialLibrary& library = site.parts().library;
  const double frequency_Hz = scene.sensor.waveform.frequency_Hz;
  const double temperature_K = surface_temperature_K(scene);
  SpecularSurfaces surfaces;
  for (std::size_t index = 0; index < library.size(); ++index) {
    surfaces.emplace_back();
    const materials::Material& material = library[library.in_state(index, state)];
    const auto medium = mirroring_medium(material);
    if (!medium) continue;
    const double known_Hz = held_frequency_Hz(*medium, frequency_Hz);
    if (known_Hz != frequency_Hz && !scene.allow_extrapolation) continue;
    surfaces.back() = materials::SpecularSurface{
        materials::permittivity_of(*medium, known_Hz, known_temperature_K(*medium, temperature_K)),
        *material.rms_height_m};
  }
  for (const ModelMaterials::Entry& entry : site.parts().model_materials)
    surfaces.push_back(entry.surface.mirror);
  return surfaces;
}

std::vector<bool> mirroring_materials(const SpecularSurfaces& dry, const SpecularSurfaces& shown) {
  std::vector<bool> mirroring(dry.size());
  for (std::size_t id = 0; id < dry.size(); ++id)
    mirroring[id] = dry[id].has_value() || shown[id].has_value();
  return mirroring;
}

void report_mirrors(const SceneDescription& scene, const materials::MaterialLibrary& library,
                    std::vector<SurfaceRecord>& records, core::ProblemList& problems) {
  const double frequency_Hz = scene.sensor.waveform.frequency_Hz;
  std::set<std::string> told;  // several materials may turn into one
  for (SurfaceRecord& record : records) {
    const auto index = library.index_of(record.shown_as);
    if (!index) continue;
    const materials::Material& material = library[*index];
    const auto medium = mirroring_medium(material);
    if (!medium) continue;
    const double known_Hz = held_frequency_Hz(*medium, frequency_Hz);
    if (known_Hz == frequency_Hz) continue;
    const materials::Interval range_Hz = materials::valid_frequency_Hz(*medium);
    const materials::Extrapolation beyond{
        "frequency_GHz of dielectric " + material.dielectric, text_GHz(frequency_Hz),
        text_GHz(range_Hz.low) + " to " + text_GHz(range_Hz.high)};
    if (scene.allow_extrapolation) record.extrapolations.push_back(beyond);
    if (!told.insert(material.name).second) continue;
    problems.warning(
        "EXTRAPOLATED", material.place, "material '" + material.name + "' at " + beyond.quantity,
        beyond.asked,
        "known for " + beyond.known +
            (scene.allow_extrapolation
                 ? "; mirrors as at " + text_GHz(known_Hz) + " GHz"
                 : "; does not mirror, or allow_extrapolation = true under [materials]"));
  }
}

void add_mirror_facts(const SiteFacts& site, const std::vector<bool>& mirroring,
                      renderer::SceneFacts& facts) {
  const auto any = [&](const std::set<terrain::MaterialId>& materials) {
    return std::any_of(materials.begin(), materials.end(),
                       [&](terrain::MaterialId id) { return mirroring[id]; });
  };
  facts.mirrored_rays_end = site.anything_rises;
  facts.ground_reflects = any(site.of_ground);
  facts.reflects = facts.ground_reflects || any(site.of_bodies);
}

}  // namespace fanbeam::scenes
