// Materials that a model's own files describe (ASAM OpenMATERIAL 3D), beside those of the library.
//
// They look as their files say at the temperature of the scene's surfaces, in every state that the
// weather leaves them in: a wetted or snow-covered surface is another material, and those files have
// none.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "materials/open_material/open_materials.h"
#include "scenes/description.h"
#include "terrain/height_field.h"

namespace fanbeam::scenes {

class ModelMaterials {
 public:
  // Ids count from `first_id`, the end of the library.
  ModelMaterials(const SceneDescription& scene, std::size_t first_id, core::ProblemList& problems);

  // The id of a glTF material of the model; nothing when the model has no such files, or they do
  // not know the name. Problems as OpenMaterials; E-LIMIT beyond 65535 materials.
  std::optional<terrain::MaterialId> id(const ModelDescription& model,
                                        const std::string& gltf_name);

  struct Entry {
    std::string name;  // "car.glb:Steel"
    materials::OpenSurface surface;
  };
  const std::vector<Entry>& all() const { return entries_; }
  std::vector<std::filesystem::path> files() const;

 private:
  using Key = std::pair<std::filesystem::path, std::filesystem::path>;  // model, materials

  materials::RadarQuery query_;
  std::size_t first_id_;
  core::ProblemList& problems_;
  std::map<std::filesystem::path, materials::OpenMaterials> opened_;
  std::map<std::pair<Key, std::string>, std::optional<terrain::MaterialId>> ids_;
  std::vector<Entry> entries_;
};

// The same materials at the scene's temperature of now; nothing where all of them are as they were.
// E-UNSUPPORTED for one that has no reflectivity then.
std::optional<std::vector<ModelMaterials::Entry>> at_temperature_of(
    const SceneDescription& scene, const std::vector<ModelMaterials::Entry>& entries,
    core::ProblemList& problems);

}  // namespace fanbeam::scenes
