#include "scenes/scene_mirrors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "materials/dielectric/dielectric_medium.h"

namespace fanbeam::scenes {
namespace {

using materials::DielectricMedium;

constexpr double kUsualTemperature_K = 288.15;

// The nearest temperature that the medium's model knows (dielectric_medium.h).
double known_temperature_K(DielectricMedium medium, double temperature_K) {
  switch (medium) {
    case DielectricMedium::water:
      return std::clamp(temperature_K, 253.15, 333.15);
    case DielectricMedium::ice:
      return std::clamp(temperature_K, 240.0, 273.15);
    case DielectricMedium::dry_soil:
    case DielectricMedium::moist_soil:
    case DielectricMedium::wet_soil:
      return std::clamp(temperature_K, 273.15, 313.15);
    default:
      return temperature_K;
  }
}

// A facet within 30 deg of the vertical: its normal is within 30 deg of the horizontal.
bool has_wall(const terrain::TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& corner) {
    const glm::dvec3& a = mesh.vertices_m[corner.x];
    const glm::dvec3 normal =
        glm::cross(mesh.vertices_m[corner.y] - a, mesh.vertices_m[corner.z] - a);
    return 2.0 * std::abs(normal.z) < glm::length(normal);
  });
}

}  // namespace

SpecularSurfaces specular_surfaces(const SceneDescription& scene,
                                   const materials::MaterialLibrary& library,
                                   materials::SurfaceState state) {
  const double frequency_Hz = scene.sensor.waveform.frequency_Hz;
  const double temperature_K =
      scene.weather.temperature_C ? *scene.weather.temperature_C + 273.15 : kUsualTemperature_K;
  SpecularSurfaces surfaces;
  for (std::size_t index = 0; index < library.size(); ++index) {
    surfaces.emplace_back();
    const materials::Material& material = library[library.in_state(index, state)];
    const auto medium = materials::dielectric_medium_named(material.dielectric);
    if (!medium || !material.rms_height_m ||
        !materials::valid_frequency_Hz(*medium).contains(frequency_Hz))
      continue;
    surfaces.back() = materials::SpecularSurface{
        materials::permittivity_of(*medium, frequency_Hz,
                                   known_temperature_K(*medium, temperature_K)),
        *material.rms_height_m};
  }
  return surfaces;
}

void add_mirror_facts(const std::vector<SpecularSurfaces>& specular,
                      const terrain::HeightField& field,
                      const std::vector<terrain::SurfacePatch>& patches,
                      const std::vector<terrain::PlacedMesh>& meshes, bool has_point_targets,
                      renderer::SceneFacts& facts) {
  const auto reflects = [&](terrain::MaterialId id) {
    return std::any_of(specular.begin(), specular.end(), [id](const SpecularSurfaces& surfaces) {
      return id < surfaces.size() && surfaces[id].has_value();
    });
  };
  facts.ground_reflects =
      std::any_of(field.cell_material.begin(), field.cell_material.end(), reflects) ||
      std::any_of(patches.begin(), patches.end(),
                  [&](const terrain::SurfacePatch& patch) { return reflects(patch.material); });
  facts.reflects = facts.ground_reflects;
  for (const terrain::PlacedMesh& placed : meshes) {
    facts.has_walls = facts.has_walls || has_wall(placed.mesh);
    facts.reflects = facts.reflects || std::any_of(placed.material_of_name.begin(),
                                                   placed.material_of_name.end(), reflects);
  }
  facts.has_point_targets = has_point_targets;
}

}  // namespace fanbeam::scenes
