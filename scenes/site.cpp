#include "scenes/site.h"

#include <algorithm>

namespace fanbeam::scenes {
SiteFacts::SiteFacts(const terrain::HeightField& ground,
                     const std::vector<terrain::SurfacePatch>& patches,
                     const std::vector<terrain::PlacedMesh>& meshes) {
  const auto [lowest, highest] =
      std::minmax_element(ground.height_m.begin(), ground.height_m.end());
  lowest_m = lowest_ground_m = *lowest;
  highest_m = highest_ground_m = *highest;
  anything_rises = !meshes.empty() || *highest > *lowest;
  std::vector<bool> met(std::size_t{1} << 16, false);
  for (const terrain::MaterialId material : ground.cell_material) met[material] = true;
  for (std::size_t id = 0; id < met.size(); ++id)
    if (met[id]) of_ground.insert(static_cast<terrain::MaterialId>(id));
  for (const terrain::SurfacePatch& patch : patches) of_ground.insert(patch.material);
  for (const terrain::PlacedMesh& placed : meshes) {
    of_bodies.insert(placed.material_of_name.begin(), placed.material_of_name.end());
    for (const glm::dvec3& vertex_m : placed.mesh.vertices_m) {
      lowest_m = std::min(lowest_m, vertex_m.z);
      highest_m = std::max(highest_m, vertex_m.z);
    }
  }
}

const renderer::Reflectivity& Site::reflectivity(materials::SurfaceState state) const {
  const auto index = static_cast<std::size_t>(state);
  std::call_once(asked_[index], [&] {
    const sensors::Waveform& waveform = parts_.waveform;
    std::vector<materials::NrcsCurve> curves =
        parts_.library.curves(state, waveform.polarisation, waveform.frequency_Hz);
    std::vector<bool> met(curves.size(), false);
    for (const std::size_t id : parts_.used) met[id] = true;
    for (const ModelMaterials::Entry& entry : parts_.model_materials)
      curves.emplace_back(entry.surface.reflectivity, waveform.polarisation, waveform.frequency_Hz);
    met.resize(curves.size(), true);
    reflectivity_[index] = renderer::Reflectivity(std::move(curves), met);
  });
  return reflectivity_[index];
}

}  // namespace fanbeam::scenes
