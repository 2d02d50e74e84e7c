#include "scenes/model_materials.h"

#include <cmath>

#include "scenes/scene_surfaces.h"

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kMostMaterials = 65535;

materials::RadarQuery query_of(const SceneDescription& scene) {
  return {scene.sensor.waveform.frequency_Hz, scene.sensor.waveform.polarisation,
          surface_temperature_K(scene), scene.allow_extrapolation};
}

}  // namespace

ModelMaterials::ModelMaterials(const SceneDescription& scene, std::size_t first_id,
                               core::ProblemList& problems)
    : query_(query_of(scene)), first_id_(first_id), problems_(problems) {}

std::optional<terrain::MaterialId> ModelMaterials::id(const ModelDescription& model,
                                                      const std::string& gltf_name) {
  if (model.open_material.empty()) return std::nullopt;
  const Key key(model.file, model.open_material);
  const auto known = ids_.find({key, gltf_name});
  if (known != ids_.end()) return known->second;

  auto opened = opened_.find(model.open_material);
  if (opened == opened_.end())
    opened = opened_
                 .emplace(model.open_material,
                          materials::OpenMaterials(model.open_material, model.open_material_root,
                                                   query_, problems_))
                 .first;
  std::optional<terrain::MaterialId>& id = ids_[{key, gltf_name}];
  if (!opened->second.knows(gltf_name)) return id;
  const std::string name = model.file.filename().string() + ":" + gltf_name;
  if (auto surface = opened->second.surface_of(gltf_name, problems_))
    entries_.push_back({name, std::move(*surface)});
  else
    entries_.push_back({name, {}});  // its problems have been told
  const std::size_t index = first_id_ + entries_.size() - 1;
  if (index >= kMostMaterials) {
    problems_.error(core::ErrorClass::limit, model.place, "model.open_material", name,
                    "at most " + std::to_string(kMostMaterials) + " materials in a scene");
    return id;
  }
  id = static_cast<terrain::MaterialId>(index);
  return id;
}

std::vector<std::filesystem::path> ModelMaterials::files() const {
  std::vector<std::filesystem::path> files;
  for (const auto& [file, materials] : opened_)
    files.insert(files.end(), materials.files().begin(), materials.files().end());
  return files;
}

std::optional<std::vector<ModelMaterials::Entry>> at_temperature_of(
    const SceneDescription& scene, const std::vector<ModelMaterials::Entry>& entries,
    core::ProblemList& problems) {
  const materials::RadarQuery query = query_of(scene);
  std::vector<ModelMaterials::Entry> now = entries;
  bool as_before = true;
  for (ModelMaterials::Entry& entry : now) {
    const std::optional<materials::SpecularSurface> mirror = entry.surface.mirror;
    auto surface = entry.surface.at(query);
    if (!surface.value) {
      problems.error(core::ErrorClass::unsupported, {}, "temperature_C",
                     core::number_text(std::round(10.0 * (query.temperature_K - 273.15)) / 10.0),
                     "one that " + entry.name + " is known at: " + surface.why_not);
      continue;
    }
    entry.surface = std::move(*surface.value);
    as_before = as_before && entry.surface.mirror == mirror;
  }
  if (as_before) return std::nullopt;
  return now;
}

}  // namespace fanbeam::scenes
