// What stands in a scene, before any weather, sensor setting or flight, but for the temperature of
// materials that models bring along: what its files give in seconds. Const, and shared by all scenes
// that are made of it (scene.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

#include "core/constants.h"
#include "materials/library/material_library.h"
#include "renderer/geometry.h"
#include "renderer/surfaces/reflectivity.h"
#include "scenes/model_materials.h"
#include "scenes/sight_map.h"
#include "sensors/sensor.h"
#include "terrain/ray_scene.h"

namespace fanbeam::scenes {

// Of ground and bodies: what bounds of effects may use whatever the conditions are.
struct SiteFacts {
  SiteFacts(const terrain::HeightField& ground, const std::vector<terrain::SurfacePatch>& patches,
            const std::vector<terrain::PlacedMesh>& meshes);

  double lowest_m = 0.0, highest_m = 0.0;
  double lowest_ground_m = 0.0, highest_ground_m = 0.0;
  bool anything_rises = false;  // bodies, or ground that is not level
  std::set<terrain::MaterialId> of_ground, of_bodies;
};

class Site {
 public:
  struct Parts {
    materials::MaterialLibrary library;
    std::set<std::size_t> used;                          // indices in the library
    std::vector<ModelMaterials::Entry> model_materials;  // ids behind the library's
    SightMap sight;                                      // nothing in it mirrors yet
    SiteFacts facts;
    std::shared_ptr<const renderer::Geometry> geometry;
    sensors::Waveform waveform;  // that materials were looked up for
  };
  explicit Site(Parts parts) : parts_(std::move(parts)) {}

  const Parts& parts() const { return parts_; }

  // By material id, in a state of the weather. A material that nothing is made of returns nothing.
  // Thread-safe; milliseconds at the first question for a state.
  const renderer::Reflectivity& reflectivity(materials::SurfaceState state) const;

 private:
  static constexpr std::size_t kStates = 4;

  Parts parts_;
  mutable std::array<std::once_flag, kStates> asked_;
  mutable std::array<renderer::Reflectivity, kStates> reflectivity_;
};

}  // namespace fanbeam::scenes
